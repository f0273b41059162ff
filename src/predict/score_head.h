#pragma once
#include <optional>
#include <span>
#include <vector>

#include "predict/camera_head.h"
#include "predict/frame_head.h"

namespace svnet::predict {

/// A trained model without its backbone: it scores camera poses from features. In frames other than `camera`
/// these are the features of frame/frame_inputs.h. Thread-safe.
class ScoreHead {
 public:
  explicit ScoreHead(const Model& model, const InferenceOptions& options = {});

  /// The number D of features: over all symmetries, or turns, of the top image that the model sees.
  Index feature_count() const { return feature_count_; }

  /// Throws Error unless features are as in scores().
  Familiarity familiarity(const Tensor& features) const;

  /// One score per pose, in order. A score does not depend on the other poses of the call, and poses a whole turn apart
  /// have the same score. Throws Error unless features are (1, D) finite f32 and every pose is in range
  /// (view/camera_pose.h).
  std::vector<float> scores(const Tensor& features, std::span<const view::CameraPose> poses) const;

  /// The same, written to `scores`, which has an element per pose. Once the workspace has seen as many poses, nothing
  /// is allocated.
  void scores(std::span<const float> features, std::span<const view::CameraPose> poses, std::span<float> scores,
              ScoreWorkspace& workspace) const;

  /// Familiarity in memory that the caller keeps.
  Familiarity familiarity(std::span<const float> features, ScoreWorkspace& workspace) const;

 private:
  void check_features(const Tensor& features) const;

  std::optional<CameraHead> camera_;
  std::optional<FrameHead> frame_;  // if there is no camera_
  Index feature_count_;
};

}  // namespace svnet::predict
