#include "train/frame_head.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "train/dataset_rows.h"
#include "train/view_targets.h"

namespace svnet::train {
namespace {

std::span<const float> features_of(Index pose, std::span<const float> features, const frame::FrameSpec& spec) {
  const auto size = static_cast<std::size_t>(frame::feature_count(spec));
  return features.subspan(static_cast<std::size_t>(pose) * size, size);
}

std::vector<double> inputs_of(const View& view, std::span<const float> features, const frame::FrameSpec& spec,
                              double trust = 1) {
  return frame::frame_inputs(
      spec, features_of(view.pose, features, spec),
      {.theta_deg = static_cast<double>(view.theta_deg), .phi_deg = static_cast<double>(view.phi_deg)}, trust);
}

frame::SeenShapes shapes_of(const ViewDataset& dataset, std::span<const float> features,
                            const std::vector<bool>& categories, const frame::FrameSpec& spec) {
  std::vector<std::vector<double>> numbers;
  for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose)
    if (categories[static_cast<std::size_t>(dataset.poses[pose].category)])
      numbers.push_back(frame::shape_numbers(spec, features_of(static_cast<Index>(pose), features, spec)));
  return frame::seen_shapes(numbers);
}

}  // namespace

FrameHead fit_frame_head(const ViewDataset& dataset, std::span<const float> features, const Scores& scores,
                         const std::vector<bool>& categories, Target target, const frame::FrameSpec& spec,
                         std::uint64_t seed, HeadChoice head, const Scores* gains) {
  check_rows(dataset, scores.paths, "scores");
  check(features.size() == dataset.poses.size() * static_cast<std::size_t>(frame::feature_count(spec)), "[head] ",
        features.size(), " features do not belong to ", dataset.poses.size(), " top views");
  const std::vector<double>& targets = target_scores(scores, target);
  std::vector<double> standard_errors, gained;
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
    examples.top.push_back(view.top ? 1 : 0);
    if (gains != nullptr) gained.push_back(target_scores(*gains, target)[i]);
  }
  examples.weight = score_weights(examples.y, standard_errors, examples.pose);

  RidgeOptions options{.seed = seed};
  for (const frame::InputGroup group : frame::input_groups(spec)) options.small_penalty.push_back(!is_of_shape(group));
  FrameHead fitted{fit_head(examples, options, head), spec, shapes_of(dataset, features, categories, spec)};
  if (gains != nullptr) fitted.gain = gain_of_left_out(examples, gained, options, fitted.fit);
  return fitted;
}

std::vector<double> predictions(const FrameHead& head, const ViewDataset& dataset, std::span<const float> features) {
  PoseExamples views{.inputs = frame::input_count(head.spec)};
  std::vector<double> trusts;
  for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose)
    trusts.push_back(
        trust(head.seen, shape_numbers(head.spec, features_of(static_cast<Index>(pose), features, head.spec))));
  for (const View& view : dataset.views) {
    const std::vector<double> inputs =
        inputs_of(view, features, head.spec, trusts[static_cast<std::size_t>(view.pose)]);
    views.x.insert(views.x.end(), inputs.begin(), inputs.end());
  }
  return predictions(head.fit, views);
}

void set_frame_head(Model& model, const FrameHead& head) {
  set_head(model, head.fit);
  model.seen = head.seen;
  model.gain = head.gain;
}

Model model_of(const FrameHead& head) {
  Model model;
  model.frame = head.spec.frame;
  model.depth = head.spec.depth;
  set_frame_head(model, head);
  return model;
}

}  // namespace svnet::train
