#pragma once
#include <cstdint>

#include "base/index.h"

namespace svnet::semantics {

/// The memory of one agglomeration. A slot holds one cluster: slot i starts as point i. Arrays have at least `stride`
/// elements and are 64-byte aligned.
struct AgglomerationState {
  Index n, stride;            ///< points; floats per row of dissimilarity, a multiple of 16
  const float* triangle;      ///< input distances as LowerTriangle; null: they are below the diagonal of dissimilarity
  float* dissimilarity;       ///< (n, stride)
  float* size;                ///< points of the cluster in each slot
  float* gone;                ///< 0, or infinity if the slot was merged into another
  float* scratch;             ///< a row of dissimilarities
  const float* only_later;    ///< elements -stride to stride: infinity up to element 0, then 0
  const float* only_earlier;  ///< elements -stride to stride: 0 before element 0, infinity from there on
  float* nearest_value;       ///< no later slot is nearer than this; infinity if there is no later slot
  float* next_value;          ///< lower bound of those to the other later slots; the largest float if there are none
  std::int32_t* nearest;      ///< the first slot at the bound, which is then exact; -1: the slot must be searched
  std::int32_t* merged_into;  ///< output
};

}  // namespace svnet::semantics
