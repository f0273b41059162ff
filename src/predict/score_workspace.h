#pragma once
#include <vector>

#include "nn/runtime/inference.h"
#include "predict/pose_layers.h"

namespace svnet::predict {

/// What a ScoreHead keeps between calls: buffers, so that later calls of the same size allocate nothing, and what
/// depends on the features alone, so that it is computed once for the same features. One call at a time may use it,
/// and one ScoreHead only.
struct ScoreWorkspace {
  bool owns_arenas = true;  ///< false: networks borrow arenas, which is cheaper for a single call
  Inference::Arena once{}, rest{};

  // Of the frame `camera`.
  Tensor features{};                            ///< (symmetries, D / symmetries), of `pictures`; empty: none
  Tensor units{};                               ///< (symmetries, units)
  std::vector<PoseLayers::Picture> pictures{};  ///< of each symmetry

  // Of a batch of poses.
  Tensor inputs{}, repeated{}, hidden{}, outputs{};  ///< `inputs`: of poses, encoded
  PoseLayers::Buffers pose_buffers{};

  std::vector<double> numbers{};  ///< frames other than `camera`: the inputs of a pose, numbers of the shape

  Inference::Arena* arena(Inference::Arena& own) const { return owns_arenas ? &own : nullptr; }
};

}  // namespace svnet::predict
