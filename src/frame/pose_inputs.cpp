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

/// A number, or the product of two.
struct Named {
  const char* name;
  double value;
  const char* factor = nullptr;  // the name of the second number
};

Named times(const Named& a, const Named& b) { return {a.name, a.value * b.value, b.name}; }

/// F and G.
double scaled_fill(const ObjectAxis& axis) {
  constexpr double kLeastFill = 1e-4;
  return std::log(std::max(axis.fill, kLeastFill)) + 2.5;
}

/// Calls add(group, named) for each input, in order: one list for values, names and groups, so that they cannot differ.
/// Allocates nothing.
template <class Add>
void list_inputs(const ObjectAxis& axis, const Heights& heights, const view::CameraPose& pose,
                 const PoseInputOptions& options, const Add& add) {
  constexpr double kLow_deg = 10;
  constexpr double kRadians = std::numbers::pi / 180;

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

std::size_t write_pose_inputs(const ObjectAxis& axis, const Heights& heights, const view::CameraPose& pose,
                              const PoseInputOptions& options, double trust, std::span<double> inputs) {
  const std::string problem = view::pose_problem(pose);
  check(problem.empty(), "[frame] ", problem);
  std::size_t count = 0;
  list_inputs(axis, heights, view::clamped_pose(pose), options, [&](InputGroup group, const Named& named) {
    inputs[count++] = is_of_shape(group) ? named.value * trust : named.value;
  });
  return count;
}

std::vector<double> pose_inputs(const ObjectAxis& axis, const Heights& heights, const view::CameraPose& pose,
                                const PoseInputOptions& options) {
  std::vector<double> values(pose_input_groups(options).size());
  write_pose_inputs(axis, heights, pose, options, 1, values);
  return values;
}

std::vector<std::string> pose_input_names(const PoseInputOptions& options) {
  std::vector<std::string> names;
  list_inputs({}, {}, {}, options, [&](InputGroup, const Named& named) {
    names.push_back(named.factor == nullptr ? named.name : joined(named.name, "*", named.factor));
  });
  return names;
}

std::vector<InputGroup> pose_input_groups(const PoseInputOptions& options) {
  std::vector<InputGroup> groups;
  list_inputs({}, {}, {}, options, [&](InputGroup group, const Named&) { groups.push_back(group); });
  return groups;
}

}  // namespace svnet::frame
