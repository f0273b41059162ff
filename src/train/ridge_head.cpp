#include "train/ridge_head.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "models/pose_head.h"
#include "train/dataset_rows.h"

namespace svnet::train {
namespace {

std::vector<double> inputs_of(const View& view, std::span<const float> features, const frame::FrameSpec& spec) {
  const auto size = static_cast<std::size_t>(frame::feature_count(spec));
  return frame::frame_inputs(
      spec, features.subspan(static_cast<std::size_t>(view.pose) * size, size),
      {.theta_deg = static_cast<double>(view.theta_deg), .phi_deg = static_cast<double>(view.phi_deg)});
}

/// The standard error of a score is NaN if it is of one problem: it is then at least as uncertain as any other.
void set_unknown_to_largest(std::vector<double>& standard_errors) {
  double largest = 0;
  for (const double error : standard_errors)
    if (std::isfinite(error)) largest = std::max(largest, error);
  for (double& error : standard_errors)
    if (!std::isfinite(error)) error = largest;
}

/// The variance of the scores within their poses.
double variance_within_poses(const RidgeExamples& e) {
  double squares = 0, freedom = 0;
  for (std::size_t begin = 0, end; begin < e.y.size(); begin = end) {
    double sum = 0, sum_of_squares = 0;
    for (end = begin; end < e.y.size() && e.pose[end] == e.pose[begin]; ++end) {
      sum += e.y[end];
      sum_of_squares += e.y[end] * e.y[end];
    }
    const auto count = static_cast<double>(end - begin);
    squares += sum_of_squares - sum * sum / count;
    freedom += count - 1;
  }
  return freedom > 0 ? squares / freedom : 0;
}

}  // namespace

RidgeHead fit_ridge_head(const ViewDataset& dataset, std::span<const float> features, const Scores& scores,
                         const std::vector<bool>& categories, Target target, const frame::FrameSpec& spec,
                         std::uint64_t seed) {
  check_rows(dataset, scores.paths, "scores");
  const std::vector<double>& targets = target == Target::individual ? scores.individual : scores.global;
  check(features.size() == dataset.poses.size() * static_cast<std::size_t>(frame::feature_count(spec)), "[ridge] ",
        features.size(), " features do not belong to ", dataset.poses.size(), " top views");
  RidgeExamples examples{.inputs = frame::input_count(spec)};
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    if (!categories[static_cast<std::size_t>(view.category)] || !std::isfinite(targets[i])) continue;
    const std::vector<double> inputs = inputs_of(view, features, spec);
    examples.x.insert(examples.x.end(), inputs.begin(), inputs.end());
    examples.y.push_back(targets[i]);
    examples.weight.push_back(scores.standard_error[i]);
    examples.pose.push_back(static_cast<std::int32_t>(view.pose));
    examples.category.push_back(static_cast<std::int32_t>(view.category));
  }
  set_unknown_to_largest(examples.weight);
  const double variance = variance_within_poses(examples);
  for (double& weight : examples.weight) weight = variance > 0 ? variance / (variance + weight * weight) : 1;

  RidgeOptions options{.seed = seed};
  for (const frame::InputGroup group : frame::input_groups(spec))
    options.small_penalty.push_back(group == frame::InputGroup::phi || group == frame::InputGroup::axis);
  return {fit_ridge(examples, options), spec};
}

std::vector<double> predictions(const RidgeHead& head, const ViewDataset& dataset, std::span<const float> features) {
  std::vector<double> predicted;
  for (const View& view : dataset.views) {
    const std::vector<double> inputs = inputs_of(view, features, head.spec);
    double score = head.fit.bias;
    for (std::size_t i = 0; i < inputs.size(); ++i) score += head.fit.weights[i] * inputs[i];
    predicted.push_back(score);
  }
  return predicted;
}

Model model_of(const RidgeHead& head) {
  Model model;
  model.frame = head.spec.frame;
  model.depth = head.spec.depth;
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
