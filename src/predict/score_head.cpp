#include "predict/score_head.h"

#include "base/error.h"
#include "predict/finite_check.h"

namespace svnet::predict {

ScoreHead::ScoreHead(const Model& model, const InferenceOptions& options) {
  if (model.frame == frame::FrameChoice::camera)
    feature_count_ = camera_.emplace(model, options).feature_count();
  else
    feature_count_ = frame_.emplace(model, options).feature_count();
}

void ScoreHead::check_features(const Tensor& features) const {
  check(features.defined() && features.shape() == Shape{1, feature_count_} && features.dtype() == DType::f32,
        "[predict] features are ", features.defined() ? to_string(features.shape()) : "none", ", the model expects ",
        to_string({1, feature_count_}), " f32");
}

Familiarity ScoreHead::familiarity(const Tensor& features) const {
  check_features(features);
  ScoreWorkspace workspace{.owns_arenas = false};
  return familiarity(features.values<float>(), workspace);
}

Familiarity ScoreHead::familiarity(std::span<const float> features, ScoreWorkspace& workspace) const {
  check_finite(features, "feature");
  return camera_ ? Familiarity{} : frame_->familiarity(features, workspace);
}

std::vector<float> ScoreHead::scores(const Tensor& features, std::span<const view::CameraPose> poses) const {
  check_features(features);
  std::vector<float> result(poses.size());
  ScoreWorkspace workspace{.owns_arenas = false};
  scores(features.values<float>(), poses, result, workspace);
  return result;
}

void ScoreHead::scores(std::span<const float> features, std::span<const view::CameraPose> poses,
                       std::span<float> scores, ScoreWorkspace& workspace) const {
  check(static_cast<Index>(features.size()) == feature_count_, "[predict] there are ", features.size(),
        " features, the model expects ", feature_count_);
  check_finite(features, "feature");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string problem = pose_problem(poses[i]);
    check(problem.empty(), "[predict] pose ", i, ": ", problem);
  }
  if (camera_)
    camera_->scores(features, poses, scores, workspace);
  else
    frame_->scores(features, poses, scores, workspace);
}

}  // namespace svnet::predict
