#include "train/ridge_head.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "models/pose_head.h"
#include "train/dataset_rows.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

std::vector<double> inputs_of(const View& view, std::span<const frame::TopFrame> frames, frame::DepthChoice depth) {
  const frame::TopFrame& top = frames[static_cast<std::size_t>(view.pose)];
  return frame::pose_inputs(
      top.axis, top.heights,
      {.theta_deg = static_cast<double>(view.theta_deg), .phi_deg = static_cast<double>(view.phi_deg)},
      frame::input_options(depth));
}

}  // namespace

RidgeHead fit_ridge_head(const ViewDataset& dataset, std::span<const frame::TopFrame> frames, const Scores& scores,
                         const std::vector<bool>& categories, Target target, frame::DepthChoice depth,
                         std::uint64_t seed) {
  check_rows(dataset, scores.paths, "scores");
  const std::vector<double>& targets = target_scores(scores, target);
  std::vector<double> standard_errors;
  RidgeExamples examples{.inputs = frame::pose_input_count(frame::input_options(depth))};
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    if (!categories[static_cast<std::size_t>(view.category)] || !std::isfinite(targets[i])) continue;
    const std::vector<double> inputs = inputs_of(view, frames, depth);
    examples.x.insert(examples.x.end(), inputs.begin(), inputs.end());
    examples.y.push_back(targets[i]);
    standard_errors.push_back(scores.standard_error[i]);
    examples.pose.push_back(static_cast<std::int32_t>(view.pose));
    examples.category.push_back(static_cast<std::int32_t>(view.category));
  }
  examples.weight = score_weights(examples.y, standard_errors, examples.pose);

  RidgeOptions options{.seed = seed};
  for (const frame::InputGroup group : frame::pose_input_groups(frame::input_options(depth)))
    options.small_penalty.push_back(group == frame::InputGroup::phi || group == frame::InputGroup::axis);
  return {fit_ridge(examples, options), depth};
}

std::vector<double> predictions(const RidgeHead& head, const ViewDataset& dataset,
                                std::span<const frame::TopFrame> frames) {
  std::vector<double> predicted;
  for (const View& view : dataset.views) {
    const std::vector<double> inputs = inputs_of(view, frames, head.depth);
    double score = head.fit.bias;
    for (std::size_t i = 0; i < inputs.size(); ++i) score += head.fit.weights[i] * inputs[i];
    predicted.push_back(score);
  }
  return predicted;
}

Model model_of(const RidgeHead& head) {
  Model model;
  model.frame = frame::FrameChoice::axis;
  model.depth = head.depth;
  model.head = models::linear_head(static_cast<Index>(head.fit.weights.size()));
  Tensor kernel = Tensor::empty({static_cast<Index>(head.fit.weights.size()), 1}), bias = Tensor::empty({1});
  const auto logit = [](double score) { return static_cast<float>(models::kLogitPerScore * score); };
  for (std::size_t i = 0; i < head.fit.weights.size(); ++i) kernel.data<float>()[i] = logit(head.fit.weights[i]);
  bias.data<float>()[0] = logit(head.fit.bias);
  model.head_parameters.set("ridge/kernel", kernel);
  model.head_parameters.set("ridge/bias", bias);
  return model;
}

}  // namespace svnet::train
