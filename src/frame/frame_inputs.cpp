#include "frame/frame_inputs.h"

#include <algorithm>

#include "base/error.h"
#include "frame/turns.h"

namespace svnet::frame {
namespace {

PoseInputOptions options_of(const FrameSpec& spec) {
  return has_axis(spec.frame) ? input_options(spec.depth) : PoseInputOptions{.axis = false};
}

}  // namespace

Index feature_count(const FrameSpec& spec) {
  return (has_axis(spec.frame) ? static_cast<Index>(kTopFrameSize) : 0) + kTurns * spec.components;
}

Index input_count(const FrameSpec& spec) { return pose_input_count(options_of(spec)) + 2 * spec.components; }

std::vector<InputGroup> input_groups(const FrameSpec& spec) {
  std::vector<InputGroup> groups = pose_input_groups(options_of(spec));
  groups.insert(groups.end(), static_cast<std::size_t>(2 * spec.components), InputGroup::turned);
  return groups;
}

void check_feature_count(const FrameSpec& spec, std::span<const float> features) {
  check(static_cast<Index>(features.size()) == feature_count(spec), "[frame] there are ", features.size(),
        " features of a top view, expected ", feature_count(spec));
}

FrameInputs::FrameInputs(const FrameSpec& spec, std::span<const float> features, double trust)
    : options_(options_of(spec)), components_(static_cast<std::size_t>(spec.components)), trust_(trust) {
  check_feature_count(spec, features);
  if (has_axis(spec.frame)) {
    top_ = from_values(features.first<kTopFrameSize>());
    features = features.subspan(kTopFrameSize);
  }
  turns_ = features;
}

void FrameInputs::write(const view::CameraPose& pose, std::span<double> inputs) const {
  const std::size_t count = write_pose_inputs(top_.axis, top_.heights, pose, options_, trust_, inputs);
  if (components_ > 0) write_turned(view::clamped_pose(pose), inputs.subspan(count));
}

/// The inputs of the group turned. Requires a clamped pose.
void FrameInputs::write_turned(const view::CameraPose& pose, std::span<double> inputs) const {
  const std::array<double, kTurns> weights = turn_weights(pose);
  const double x = scaled_elevation(pose);
  const std::span<double> means = inputs.first(components_), times_x = inputs.subspan(components_);
  std::ranges::fill(means, 0.0);
  for (std::size_t turn = 0; turn < weights.size(); ++turn) {
    if (weights[turn] == 0) continue;
    const std::span<const float> values = turns_.subspan(turn * components_, components_);
    for (std::size_t i = 0; i < components_; ++i) means[i] += weights[turn] * static_cast<double>(values[i]);
  }
  for (std::size_t i = 0; i < components_; ++i) {
    times_x[i] = x * means[i] * trust_;
    means[i] *= trust_;
  }
}

std::vector<double> frame_inputs(const FrameSpec& spec, std::span<const float> features, const view::CameraPose& pose,
                                 double trust) {
  std::vector<double> inputs(static_cast<std::size_t>(input_count(spec)));
  FrameInputs(spec, features, trust).write(pose, inputs);
  return inputs;
}

}  // namespace svnet::frame
