#include "train/frame_head.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "train/dataset_rows.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

std::vector<double> inputs_of(const View& view, std::span<const float> features, const frame::FrameSpec& spec) {
  const auto size = static_cast<std::size_t>(frame::feature_count(spec));
  return frame::frame_inputs(
      spec, features.subspan(static_cast<std::size_t>(view.pose) * size, size),
      {.theta_deg = static_cast<double>(view.theta_deg), .phi_deg = static_cast<double>(view.phi_deg)});
}

}  // namespace

FrameHead fit_frame_head(const ViewDataset& dataset, std::span<const float> features, const Scores& scores,
                         const std::vector<bool>& categories, Target target, const frame::FrameSpec& spec,
                         std::uint64_t seed, HeadChoice head) {
  check_rows(dataset, scores.paths, "scores");
  check(features.size() == dataset.poses.size() * static_cast<std::size_t>(frame::feature_count(spec)), "[head] ",
        features.size(), " features do not belong to ", dataset.poses.size(), " top views");
  const std::vector<double>& targets = target_scores(scores, target);
  std::vector<double> standard_errors;
  PoseExamples examples{.inputs = frame::input_count(spec)};
  for (std::size_t i = 0; i < dataset.views.size(); ++i) {
    const View& view = dataset.views[i];
    if (!categories[static_cast<std::size_t>(view.category)] || !std::isfinite(targets[i])) continue;
    const std::vector<double> inputs = inputs_of(view, features, spec);
    examples.x.insert(examples.x.end(), inputs.begin(), inputs.end());
    examples.y.push_back(targets[i]);
    standard_errors.push_back(scores.standard_error[i]);
    examples.pose.push_back(static_cast<std::int32_t>(view.pose));
    examples.category.push_back(static_cast<std::int32_t>(view.category));
  }
  examples.weight = score_weights(examples.y, standard_errors, examples.pose);

  RidgeOptions options{.seed = seed};
  for (const frame::InputGroup group : frame::input_groups(spec))
    options.small_penalty.push_back(group == frame::InputGroup::phi || group == frame::InputGroup::axis);
  return {fit_head(examples, options, head), spec};
}

std::vector<double> predictions(const FrameHead& head, const ViewDataset& dataset, std::span<const float> features) {
  PoseExamples views{.inputs = frame::input_count(head.spec)};
  for (const View& view : dataset.views) {
    const std::vector<double> inputs = inputs_of(view, features, head.spec);
    views.x.insert(views.x.end(), inputs.begin(), inputs.end());
  }
  return predictions(head.fit, views);
}

Model model_of(const FrameHead& head) {
  Model model;
  model.frame = head.spec.frame;
  model.depth = head.spec.depth;
  set_head(model, head.fit);
  return model;
}

}  // namespace svnet::train
