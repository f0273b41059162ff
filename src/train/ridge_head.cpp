#include "train/ridge_head.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
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
                         std::uint64_t seed, HeadChoice head) {
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
  return {fit_head(examples, options, head), depth};
}

std::vector<double> predictions(const RidgeHead& head, const ViewDataset& dataset,
                                std::span<const frame::TopFrame> frames) {
  RidgeExamples views{.inputs = frame::pose_input_count(frame::input_options(head.depth))};
  for (const View& view : dataset.views) {
    const std::vector<double> inputs = inputs_of(view, frames, head.depth);
    views.x.insert(views.x.end(), inputs.begin(), inputs.end());
  }
  return predictions(head.fit, views);
}

Model model_of(const RidgeHead& head) {
  Model model;
  model.frame = frame::FrameChoice::axis;
  model.depth = head.depth;
  set_head(model, head.fit);
  return model;
}

}  // namespace svnet::train
