#include "view/pose_grid.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace svnet::view {
namespace {

constexpr Index kMostThetaSteps = 3600, kMostPhiSteps = 1000;

double elevation_of(const GridSpec& spec, Index step) {
  if (step == 0) return spec.lowest_phi_deg;
  if (step == spec.phi_steps - 1) return spec.highest_phi_deg;
  return spec.lowest_phi_deg + (spec.highest_phi_deg - spec.lowest_phi_deg) * static_cast<double>(step) /
                                   static_cast<double>(spec.phi_steps - 1);
}

Index poses_at(const GridSpec& spec, double phi_deg) { return phi_deg == kTopView.phi_deg ? 1 : spec.theta_steps; }

void check_grid(const GridSpec& spec) {
  const auto check_steps = [](const char* name, Index steps, Index most) {
    check(steps >= 1 && steps <= most, "[view] a grid of ", steps, " ", name, " steps, expected 1 to ", most);
  };
  check_steps("theta", spec.theta_steps, kMostThetaSteps);
  check_steps("phi", spec.phi_steps, kMostPhiSteps);
  check(spec.lowest_phi_deg >= 0 && spec.lowest_phi_deg <= spec.highest_phi_deg && spec.highest_phi_deg <= 90,
        "[view] a grid with phi from ", spec.lowest_phi_deg, " to ", spec.highest_phi_deg,
        " degrees, expected 0 <= lowest <= highest <= 90");
}

}  // namespace

Index grid_size(const GridSpec& spec) {
  check_grid(spec);
  Index count = 0;
  for (Index step = 0; step < spec.phi_steps; ++step) count += poses_at(spec, elevation_of(spec, step));
  return count;
}

void for_each_pose(const GridSpec& spec, FunctionRef<void(const CameraPose&)> add) {
  check_grid(spec);
  for (Index step = 0; step < spec.phi_steps; ++step) {
    const double phi_deg = elevation_of(spec, step);
    if (phi_deg == kTopView.phi_deg) {
      add(kTopView);
      continue;
    }
    for (Index i = 0; i < spec.theta_steps; ++i)
      add({360.0 * static_cast<double>(i) / static_cast<double>(spec.theta_steps), phi_deg});
  }
}

std::vector<CameraPose> pose_grid(const GridSpec& spec) {
  std::vector<CameraPose> poses;
  poses.reserve(static_cast<std::size_t>(grid_size(spec)));
  for_each_pose(spec, [&](const CameraPose& pose) { poses.push_back(pose); });
  return poses;
}

std::vector<CameraPose> paper_grid() {
  std::vector<CameraPose> poses;
  for (int phi_deg = 45; phi_deg <= 75; phi_deg += 15)
    for (int theta_deg = 0; theta_deg < 360; theta_deg += 45)
      if (theta_deg != 270) poses.push_back({static_cast<double>(theta_deg), static_cast<double>(phi_deg)});
  poses.push_back({90, 90});
  return poses;
}

std::vector<CameraPose> fibonacci_half_sphere(Index count, double lowest_phi_deg) {
  check(count > 0, "[view] ", count, " poses are no half-sphere, expected at least one");
  check(lowest_phi_deg >= 0 && lowest_phi_deg < 90, "[view] the lowest phi is ", lowest_phi_deg,
        " degrees, expected one in [0, 90)");
  constexpr double kGoldenAngle_deg = 360 * (2 - std::numbers::phi);
  const double lowest = std::sin(lowest_phi_deg * std::numbers::pi / 180);
  std::vector<CameraPose> poses;
  for (Index i = 0; i < count; ++i) {
    const double height = lowest + (1 - lowest) * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    poses.push_back(
        {std::fmod(static_cast<double>(i) * kGoldenAngle_deg, 360.0), std::asin(height) * 180 / std::numbers::pi});
  }
  return poses;
}

}  // namespace svnet::view
