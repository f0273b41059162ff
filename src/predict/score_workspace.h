#pragma once
#include <vector>

#include "nn/runtime/inference.h"

namespace svnet::predict {

/// What a ScoreHead keeps between calls: buffers, so that later calls of the same size allocate nothing, and what
/// depends on the features alone, so that it is computed once for the same features. One call at a time may use it,
/// and one ScoreHead only.
struct ScoreWorkspace {
  bool owns_arenas = true;  ///< false: networks borrow arenas, which is cheaper for a single call
  Inference::Arena once{}, each{};

  // Of the frame `camera`.
  Tensor features{};           ///< (symmetries, D / symmetries), those that `picture` belongs to; empty: none
  Tensor picture{};            ///< (symmetries, units), the part of the network that depends on the features alone
  int repeated_symmetry = -1;  ///< whose row of `picture` fills `repeated`

  Tensor repeated{}, inputs{}, outputs{};  ///< of a batch of poses
  std::vector<double> numbers{};           ///< frames other than `camera`: the inputs of a pose, numbers of the shape

  Inference::Arena* arena(Inference::Arena& own) const { return owns_arenas ? &own : nullptr; }
};

}  // namespace svnet::predict
