#include "train/stages/predictions.h"

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "predict/next_head.h"
#include "predict/score_head.h"
#include "train/stages/top_features.h"
#include "train/view_inputs.h"

namespace svnet::train {
namespace {

/// What the head takes, for every view. The features of the first stage serve if the backbone was not trained.
std::unique_ptr<ViewInputs> head_inputs(const Run& run, FeaturesStage& features, const Model& model) {
  const Config& config = run.config;
  if (config.training.fine_tune == FineTune::none && model.symmetries == 1)
    return std::make_unique<FeatureInputs>(run.dataset, features.features(config.sv_net.backbone, config.sv_net.layer));
  return std::make_unique<ImageInputs>(run.dataset, model.preprocessing,
                                       std::make_shared<Inference>(model.backbone_graph, model.backbone_parameters,
                                                                   model.backbone_graph.find(model.backbone_output),
                                                                   inference_options(model, run.inference)),
                                       ImageInputs::Options{.orientations = model.symmetries, .flat = true});
}

/// The camera poses of the views of a pose.
std::vector<view::CameraPose> candidates(const ViewDataset& dataset, Index pose) {
  std::vector<view::CameraPose> poses;
  for (const View& view : dataset.views_of(pose))
    poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
  return poses;
}

/// In a frame other than `camera`.
std::vector<double> frame_scores(const Run& run, FeaturesStage& features, const Model& model) {
  const predict::ScoreHead head(model, run.inference);
  const std::vector<float> of_poses = top_features(run, features, model);
  std::vector<double> predicted;
  for (std::size_t pose = 0; pose < run.dataset.poses.size(); ++pose) {
    Tensor top = Tensor::empty({1, head.feature_count()});
    std::copy_n(of_poses.data() + static_cast<Index>(pose) * top.size(), top.size(), top.data<float>());
    const std::vector<float> scores = head.scores(top, candidates(run.dataset, static_cast<Index>(pose)));
    predicted.insert(predicted.end(), scores.begin(), scores.end());
  }
  return predicted;
}

/// In the frame `camera`.
std::vector<double> camera_scores(const Run& run, FeaturesStage& features_stage, const Model& model) {
  const std::unique_ptr<ViewInputs> inputs = head_inputs(run, features_stage, model);
  const predict::ScoreHead head(model, run.inference);
  const Index dimension = head.feature_count();
  const auto pose_count = static_cast<Index>(run.dataset.poses.size());
  std::vector<double> predicted;
  constexpr Index kPoses = 16;  // that share a batch
  for (Index first = 0; first < pose_count; first += kPoses) {
    const Index last = std::min(first + kPoses, pose_count);
    std::vector<Index> top_views;
    for (Index pose = first; pose < last; ++pose)
      for (int orientation = 0; orientation < model.symmetries; ++orientation)
        top_views.push_back(run.dataset.top_view(pose) * model.symmetries + orientation);
    const Tensor features = inputs->batch(top_views);
    for (Index pose = first; pose < last; ++pose) {
      Tensor top = Tensor::empty({1, dimension});
      std::copy_n(features.data<float>() + (pose - first) * dimension, dimension, top.data<float>());
      const std::vector<float> scores = head.scores(top, candidates(run.dataset, pose));
      predicted.insert(predicted.end(), scores.begin(), scores.end());
    }
  }
  return predicted;
}

/// What scores of the next view are made of.
struct NextScoring {
  const Run& run;
  predict::ScoreHead head;
  predict::NextHead next;
  std::vector<float> features;  // (poses, D)
  std::vector<frame::ViewShape> shapes;

  std::vector<double> scores(std::span<const std::int32_t> taken, Index per_pose) const {
    const ViewDataset& dataset = run.dataset;
    const auto dimension = static_cast<std::size_t>(head.feature_count());
    predict::ScoreWorkspace workspace{.owns_arenas = false};
    std::vector<double> all;
    for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose) {
      const std::span<const float> of_pose = std::span(features).subspan(pose * dimension, dimension);
      std::vector<frame::TakenView> views;
      for (const std::int32_t view :
           taken.subspan(pose * static_cast<std::size_t>(per_pose), static_cast<std::size_t>(per_pose))) {
        const View& of_view = dataset.views[static_cast<std::size_t>(view)];
        views.push_back({{static_cast<double>(of_view.theta_deg), static_cast<double>(of_view.phi_deg)},
                         shapes[static_cast<std::size_t>(view)]});
      }
      const std::vector<view::CameraPose> poses = candidates(dataset, static_cast<Index>(pose));
      std::vector<float> of_candidates(poses.size());
      next.scores(of_pose, head.familiarity(of_pose, workspace).trust, views, poses, of_candidates, workspace);
      all.insert(all.end(), of_candidates.begin(), of_candidates.end());
    }
    return all;
  }
};

}  // namespace

NextScores next_scores(const Run& run, FeaturesStage& features, const Model& model) {
  if (model.next_head.nodes().empty()) return {};
  // Networks cannot be moved: make_shared could not construct it.
  const std::shared_ptr<const NextScoring> scoring(
      new NextScoring{run, predict::ScoreHead(model, run.inference), predict::NextHead(model, run.inference),
                      top_features(run, features, model), features.view_shapes()});
  return [scoring](std::span<const std::int32_t> taken, Index per_pose) { return scoring->scores(taken, per_pose); };
}

std::vector<double> predicted_scores(const Run& run, FeaturesStage& features, const Model& model) {
  return model.frame == frame::FrameChoice::camera ? camera_scores(run, features, model)
                                                   : frame_scores(run, features, model);
}

}  // namespace svnet::train
