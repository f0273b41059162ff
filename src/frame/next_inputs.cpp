#include "frame/next_inputs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "frame/top_frame.h"

namespace svnet::frame {
namespace {

constexpr std::size_t kRelations = 6, kFactors = 3;  // factors: what a shape is multiplied by
constexpr std::size_t kPairInputs = kRelations + kFactors * kViewShapeSize;
constexpr double kRadians = std::numbers::pi / 180;

/// c of pose_inputs.h.
double horizontal(const view::CameraPose& pose) { return is_top(pose) ? 0 : std::cos(pose.phi_deg * kRadians); }

/// Adds the inputs of the groups relation and second, each times `share`.
void add_pair_inputs(const view::CameraPose& candidate, const TakenView& taken, double share, std::span<double> to) {
  const double near = std::min(view::angle_between_deg(candidate, taken.pose), 90.0) / 90;
  const double plane = horizontal(candidate) * horizontal(taken.pose);
  const double turn = (candidate.theta_deg - taken.pose.theta_deg) * kRadians;
  const double x = scaled_elevation(candidate), taken_x = scaled_elevation(taken.pose);
  const std::array<double, kRelations> relations{
      near, near * near, plane * std::cos(turn), plane * std::cos(2 * turn), std::abs(x - taken_x) / 2, x * taken_x};
  for (std::size_t i = 0; i < kRelations; ++i) to[i] += share * relations[i];
  const std::array<double, kFactors> factors{x, near, plane * std::cos(turn)};
  for (std::size_t s = 0; s < kViewShapeSize; ++s)
    for (std::size_t f = 0; f < kFactors; ++f)
      to[kRelations + s * kFactors + f] += share * static_cast<double>(taken.shape[s]) * factors[f];
}

}  // namespace

ViewShape view_shape(const Image& picture) {
  const ObjectShape shape = shape_of(top_frame(picture).axis, {});
  if (!std::isfinite(shape.elongation)) return {};
  return {static_cast<float>(shape.elongation), static_cast<float>(shape.skew), static_cast<float>(shape.fill)};
}

Index next_input_count(const FrameSpec& spec) { return input_count(spec) + static_cast<Index>(kPairInputs); }

std::vector<InputGroup> next_input_groups(const FrameSpec& spec) {
  std::vector<InputGroup> groups = input_groups(spec);
  groups.insert(groups.end(), kRelations, InputGroup::relation);
  groups.insert(groups.end(), kPairInputs - kRelations, InputGroup::second);
  return groups;
}

NextInputs::NextInputs(const FrameSpec& spec, std::span<const float> features, std::span<const TakenView> taken,
                       double trust)
    : of_pose_(spec, features, trust), count_(static_cast<std::size_t>(input_count(spec))), taken_(taken) {
  check(!taken.empty(), "[next] no view was taken");
  for (const TakenView& view : taken) {
    check(std::ranges::all_of(view.shape, [](float value) { return std::isfinite(value); }),
          "[next] the shape of a taken view is not finite");
    const std::string problem = view::pose_problem(view.pose);
    check(problem.empty(), "[next] the pose of a taken view: ", problem);
  }
}

void NextInputs::write(const view::CameraPose& pose, std::span<double> inputs) const {
  of_pose_.write(pose, inputs.first(count_));
  const std::span<double> pairs = inputs.subspan(count_, kPairInputs);
  std::ranges::fill(pairs, 0.0);
  const view::CameraPose candidate = view::clamped_pose(pose);
  const double share = 1 / static_cast<double>(taken_.size());
  for (const TakenView& view : taken_)
    add_pair_inputs(candidate, {view::clamped_pose(view.pose), view.shape}, share, pairs);
}

}  // namespace svnet::frame
