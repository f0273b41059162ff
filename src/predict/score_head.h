#pragma once
#include <span>
#include <vector>

#include "io/models/model_file.h"
#include "nn/runtime/inference.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// A trained model without its backbone: it scores camera poses from features. In frames other than `camera`
/// these are the features of frame/frame_inputs.h. Thread-safe.
class ScoreHead {
 public:
  explicit ScoreHead(const Model& model, const InferenceOptions& options = {});

  /// The number D of features: over all symmetries, or turns, of the top image that the model sees.
  Index feature_count() const { return feature_count_; }

  /// How far the top view is from those that the head was fitted to, and how far the farthest of them is
  /// (frame/seen_shapes.h). Both are 0 in the frame `camera`. Throws Error unless features are as in scores().
  struct Familiarity {
    double distance = 0, limit = 0;
    /// The share of the head's terms of the shape that counts.
    double trust = 1;
  };
  Familiarity familiarity(const Tensor& features) const;

  /// One score per pose, in order. A score does not depend on the other poses of the call, and poses a whole turn apart
  /// have the same score. Throws Error unless features are (1, D) finite f32 and every pose is in range
  /// (view/camera_pose.h).
  std::vector<float> scores(const Tensor& features, std::span<const view::CameraPose> poses) const;

 private:
  void check_features(const Tensor& features) const;
  std::vector<float> camera_scores(const Tensor& features, std::span<const view::CameraPose> poses) const;
  std::vector<float> frame_scores(const Tensor& features, std::span<const view::CameraPose> poses) const;

  frame::FrameSpec spec_;
  frame::SeenShapes seen_;
  models::AngleEncoding angles_;
  int symmetries_;
  Index feature_count_;
  Inference network_;
};

}  // namespace svnet::predict
