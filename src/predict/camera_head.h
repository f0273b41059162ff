#pragma once
#include <optional>
#include <span>

#include "data/model.h"
#include "nn/runtime/inference.h"
#include "predict/pose_layers.h"
#include "predict/score_workspace.h"
#include "predict/split_graph.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// The head of a model in the frame `camera`. What depends on the features alone is computed once for all poses
/// (split_graph.h, pose_layers.h), if the network has that form; otherwise the whole network is run for each pose.
/// Thread-safe.
class CameraHead {
 public:
  CameraHead(const Model& model, const InferenceOptions& options);

  /// D, over all symmetries.
  Index feature_count() const { return symmetries_ * dimension_; }

  /// Writes one score per pose. A score does not depend on the other poses. Requires feature_count() features and poses
  /// without problems. Throws Error for a score that is not finite.
  void scores(std::span<const float> features, std::span<const view::CameraPose> poses, std::span<float> scores,
              ScoreWorkspace& workspace) const;

 private:
  CameraHead(const Model& model, const std::optional<SplitGraph>& split, const InferenceOptions& options);
  void set_features(std::span<const float> features, ScoreWorkspace& workspace) const;
  void reserve(Index rows, ScoreWorkspace& workspace) const;
  /// The network's outputs for `count` rows of workspace.inputs.
  void run(int symmetry, Index count, ScoreWorkspace& workspace) const;

  models::AngleEncoding angles_;
  int symmetries_;
  Index dimension_;                // of the features of one symmetry
  std::optional<Inference> once_;  // features -> units; with it:
  std::optional<PoseLayers> layers_;
  Inference rest_;  // the outputs of layers_, or features and angles -> score
};

}  // namespace svnet::predict
