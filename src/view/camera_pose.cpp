#include "view/camera_pose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace svnet::view {
namespace {

constexpr double kLowestTheta_deg = -360, kHighestTheta_deg = 720, kLowestPhi_deg = 0, kHighestPhi_deg = 90;

/// All digits that the number needs: "90.0002", not "90".
std::string exact(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number, std::chars_format::general).ptr};
}

std::string angle_problem(const char* name, double angle_deg, double lowest_deg, double highest_deg) {
  if (!std::isfinite(angle_deg)) return joined(name, " ", angle_deg, " is not finite");
  if (angle_deg >= lowest_deg - kAngleTolerance_deg && angle_deg <= highest_deg + kAngleTolerance_deg) return "";
  return joined(name, " ", exact(angle_deg), " is outside [", lowest_deg, ", ", highest_deg, "] degrees");
}

}  // namespace

std::string pose_problem(const CameraPose& pose) {
  const std::string theta = angle_problem("theta", pose.theta_deg, kLowestTheta_deg, kHighestTheta_deg);
  return theta.empty() ? angle_problem("phi", pose.phi_deg, kLowestPhi_deg, kHighestPhi_deg) : theta;
}

CameraPose clamped_pose(const CameraPose& pose) {
  return {std::clamp(pose.theta_deg, kLowestTheta_deg, kHighestTheta_deg),
          std::clamp(pose.phi_deg, kLowestPhi_deg, kHighestPhi_deg)};
}

double angle_between_deg(const CameraPose& a, const CameraPose& b) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double sin_a = std::sin(a.phi_deg * kRadians), cos_a = std::cos(a.phi_deg * kRadians);
  const double sin_b = std::sin(b.phi_deg * kRadians), cos_b = std::cos(b.phi_deg * kRadians);
  const double turn = (a.theta_deg - b.theta_deg) * kRadians, along = cos_a * sin_b - sin_a * cos_b * std::cos(turn);
  // Exact for small angles too, unlike the arc cosine (Vincenty's formula on a sphere).
  const double across = std::hypot(cos_b * std::sin(turn), along);
  return std::atan2(across, sin_a * sin_b + cos_a * cos_b * std::cos(turn)) / kRadians;
}

}  // namespace svnet::view
