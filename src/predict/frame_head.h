#pragma once
#include <span>

#include "data/model.h"
#include "nn/runtime/inference.h"
#include "predict/score_workspace.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// How far a top view is from those that a head was fitted to, and how far the farthest of them is
/// (frame/seen_shapes.h). Both are 0 in the frame `camera`.
struct Familiarity {
  double distance = 0, limit = 0;
  /// The share of the head's terms of the shape that counts.
  double trust = 1;
};

/// The head of a model in a frame other than `camera`, on the inputs of frame/frame_inputs.h. Thread-safe.
class FrameHead {
 public:
  FrameHead(const Model& model, const InferenceOptions& options);

  Index feature_count() const { return frame::feature_count(spec_); }
  Familiarity familiarity(std::span<const float> features, ScoreWorkspace& workspace) const;

  /// Writes one score per pose. A score does not depend on the other poses. Requires feature_count() features and poses
  /// without problems. Throws Error for a score that is not finite, and as frame_inputs() does.
  void scores(std::span<const float> features, std::span<const view::CameraPose> poses, std::span<float> scores,
              ScoreWorkspace& workspace) const;

 private:
  frame::FrameSpec spec_;
  Index input_count_;
  frame::SeenShapes seen_;
  Inference network_;
};

}  // namespace svnet::predict
