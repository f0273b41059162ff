#include "frame/pose_inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"

namespace svnet::frame {
namespace {

struct Named {
  std::string name;
  double value;
};

Named times(const Named& a, const Named& b) { return {a.name + "*" + b.name, a.value * b.value}; }

struct PoseInput {
  Named named;
  InputGroup group;
};

/// F and G.
double scaled_fill(const ObjectAxis& axis) {
  constexpr double kLeastFill = 1e-4;
  return std::log(std::max(axis.fill, kLeastFill)) + 2.5;
}

/// One list for values, names and groups, so that they cannot differ.
std::vector<PoseInput> list_inputs(const ObjectAxis& axis, const Heights& heights, const view::CameraPose& pose,
                                   const PoseInputOptions& options) {
  constexpr double kLow_deg = 10;
  constexpr double kRadians = std::numbers::pi / 180;
  std::vector<PoseInput> inputs;
  const auto add = [&](InputGroup group, const Named& named) { inputs.push_back({named, group}); };

  const Named x{"x", scaled_elevation(pose)};
  add(InputGroup::phi, x);
  add(InputGroup::phi, {"x^2-1", x.value * x.value - 1});
  add(InputGroup::phi, {"top", is_top(pose) ? 1.0 : 0.0});
  add(InputGroup::phi, {"low", pose.phi_deg < kLow_deg ? 1.0 : 0.0});

  const double found = axis.kind == AxisKind::found ? 1 : 0;
  const double cos_phi = is_top(pose) ? 0 : std::cos(pose.phi_deg * kRadians);
  const double alpha = (pose.theta_deg - axis.direction_deg) * kRadians, slender = 2 * (1 - axis.elongation) * cos_phi;
  const std::array<Named, 3> terms{{{"a1", found * 10 * axis.skew * cos_phi * std::cos(alpha)},
                                    {"a2", found * slender * std::cos(2 * alpha)},
                                    {"a4", found * slender * std::cos(4 * alpha)}}};
  if (options.axis) {
    const Named missing{"m", 1 - found};
    for (const Named& term : terms) add(InputGroup::axis, term);
    for (const Named& term : terms) add(InputGroup::axis, times(term, x));
    add(InputGroup::axis, missing);
    add(InputGroup::axis, times(missing, x));
  }

  const ObjectShape shape = shape_of(axis, heights);
  const auto if_known = [](double number) { return std::isnan(number) ? 0.0 : number; };
  if (options.shape) {
    const std::array<Named, 3> shapes{
        {{"E", if_known(shape.elongation)}, {"S", if_known(shape.skew)}, {"F", if_known(shape.fill)}}};
    for (const Named& number : shapes) add(InputGroup::shape, times(number, x));
    for (const Named& term : terms)
      for (const Named& number : shapes) add(InputGroup::shape, times(term, number));
  }

  if (options.heights) {
    const double known = heights.are_known ? 1 : 0;
    const std::array<Named, 3> sizes{
        {{"T", if_known(shape.height)}, {"W", if_known(shape.slimness)}, {"G", known * scaled_fill(axis)}}};
    const Named missing{"h", 1 - known};
    for (const Named& size : sizes) add(InputGroup::heights, size);
    for (const Named& size : sizes) add(InputGroup::heights, times(size, x));
    for (const Named& term : terms)
      for (std::size_t i = 0; i < 2; ++i) add(InputGroup::heights, times(term, sizes[i]));
    add(InputGroup::heights, missing);
    add(InputGroup::heights, times(missing, x));
  }
  return inputs;
}

}  // namespace

ObjectShape shape_of(const ObjectAxis& axis, const Heights& heights) {
  constexpr double kMostSlender = 2, kUnknown = std::numeric_limits<double>::quiet_NaN();
  ObjectShape shape{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  if (axis.kind != AxisKind::unclear) {
    shape.elongation = 2 * (axis.elongation - 0.5);
    shape.skew = 10 * axis.skew - 0.5;
    shape.fill = scaled_fill(axis);
  }
  if (heights.are_known) {
    shape.height = heights.height - 0.25;
    shape.slimness = (heights.width > 0 ? std::min(heights.height / heights.width, kMostSlender) : 0) - 0.5;
  }
  return shape;
}

double scaled_elevation(const view::CameraPose& pose) { return (pose.phi_deg - 65) / 15; }

bool is_top(const view::CameraPose& pose) { return pose.phi_deg >= 89.5; }

std::vector<double> pose_inputs(const ObjectAxis& axis, const Heights& heights, const view::CameraPose& pose,
                                const PoseInputOptions& options) {
  const std::string problem = view::pose_problem(pose);
  check(problem.empty(), "[frame] ", problem);
  std::vector<double> values;
  for (const PoseInput& input : list_inputs(axis, heights, view::clamped_pose(pose), options))
    values.push_back(input.named.value);
  return values;
}

std::vector<std::string> pose_input_names(const PoseInputOptions& options) {
  std::vector<std::string> names;
  for (const PoseInput& input : list_inputs({}, {}, {}, options)) names.push_back(input.named.name);
  return names;
}

std::vector<InputGroup> pose_input_groups(const PoseInputOptions& options) {
  std::vector<InputGroup> groups;
  for (const PoseInput& input : list_inputs({}, {}, {}, options)) groups.push_back(input.group);
  return groups;
}

}  // namespace svnet::frame
