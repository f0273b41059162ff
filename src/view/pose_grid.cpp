#include "view/pose_grid.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace svnet::view {

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
