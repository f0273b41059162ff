#include "frame/frame_inputs.h"

#include "base/error.h"
#include "frame/turns.h"

namespace svnet::frame {
namespace {

PoseInputOptions options_of(const FrameSpec& spec) {
  return has_axis(spec.frame) ? input_options(spec.depth) : PoseInputOptions{.axis = false};
}

/// Adds the inputs of the group turned.
void add_turned_inputs(std::vector<double>& inputs, Index component_count, std::span<const float> turns,
                       const view::CameraPose& pose) {
  const view::CameraPose clamped = view::clamped_pose(pose);
  const std::array<double, kTurns> weights = turn_weights(clamped);
  const double x = scaled_elevation(clamped);
  const auto components = static_cast<std::size_t>(component_count), first = inputs.size();
  inputs.resize(first + 2 * components, 0.0);
  for (std::size_t turn = 0; turn < weights.size(); ++turn) {
    if (weights[turn] == 0) continue;
    const std::span<const float> values = turns.subspan(turn * components, components);
    for (std::size_t i = 0; i < components; ++i) inputs[first + i] += weights[turn] * static_cast<double>(values[i]);
  }
  for (std::size_t i = 0; i < components; ++i) inputs[first + components + i] = x * inputs[first + i];
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

std::vector<double> frame_inputs(const FrameSpec& spec, std::span<const float> features, const view::CameraPose& pose,
                                 double trust) {
  check_feature_count(spec, features);
  TopFrame top;
  if (has_axis(spec.frame)) {
    top = from_values(features.first<kTopFrameSize>());
    features = features.subspan(kTopFrameSize);
  }
  std::vector<double> inputs = pose_inputs(top.axis, top.heights, pose, options_of(spec));
  if (spec.components > 0) add_turned_inputs(inputs, spec.components, features, pose);
  if (trust == 1) return inputs;
  const std::vector<InputGroup> groups = input_groups(spec);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (is_of_shape(groups[i])) inputs[i] *= trust;
  return inputs;
}

}  // namespace svnet::frame
