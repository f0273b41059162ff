#pragma once
#include <cstdint>

#include "base/index.h"
#include "semantics/linkage.h"

namespace svnet::semantics {

/// The memory of one agglomeration. A slot holds one cluster: slot i starts as point i. Arrays have at least `stride`
/// elements and are 64-byte aligned.
struct AgglomerationState {
  Index n, stride;            ///< points; floats per row of dissimilarity, a multiple of 16
  const float* triangle;      ///< input distances as LowerTriangle; null: they are below the diagonal of dissimilarity
  float* dissimilarity;       ///< (n, stride)
  float* size;                ///< points of the cluster in each slot
  float* gone;                ///< 0, or infinity if the slot was merged into another
  float* nearest_value;       ///< lower bound of the dissimilarity to the nearest later slot; infinity if there is none
  std::int32_t* nearest;      ///< the slot that was nearest when the bound was computed
  std::int32_t* merged_into;  ///< output
};

/// Merges the nearest two clusters until k are left. Sets merged_into[i] to the earlier slot that slot i was merged
/// into, or to i. The result has the same bits on every instruction set: there is no fused multiply-add, and a minimum
/// does not depend on the order of its operands.
void agglomerate(Linkage linkage, Index k, AgglomerationState state);

}  // namespace svnet::semantics
