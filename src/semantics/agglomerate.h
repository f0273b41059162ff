#pragma once
#include "semantics/agglomerative.h"

namespace svnet {

/// What merging works in. Arrays have at least `stride` entries and start on 64-byte borders.
struct AgglomerationState {
  Index n, stride;        ///< points; floats of a row, whole lines
  const float* triangle;  ///< the distances on entry, as LowerTriangle; or null: below the diagonal of dissimilarity
  float* dissimilarity;   ///< (n, stride)
  float* size;            ///< of the cluster in each slot
  float* gone;            ///< 0, or infinity for slots that were merged away
  float* nearest_value;   ///< to the nearest later slot: a lower bound; infinity where there is none
  std::int32_t* nearest;  ///< that slot, when the bound was found
  std::int32_t* merged_into;
};

/// Merges the nearest two clusters until k are left. merged_into[i] becomes the earlier slot that slot i was merged
/// into, or i. The same bits on every instruction set: nothing is fused, and minima do not depend on their order.
void agglomerate(Linkage linkage, Index k, AgglomerationState state);

}  // namespace svnet
