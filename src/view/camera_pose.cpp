#include "view/camera_pose.h"

#include <charconv>
#include <cmath>

#include "base/error.h"

namespace svnet {
namespace {

/// The shortest text that reads back as this number: "95", "90.00010000001".
std::string shortest_text(double number) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::general).ptr;
  return {text, end};
}

std::string angle_problem(const char* name, double angle_deg, double lowest_deg, double highest_deg) {
  if (!std::isfinite(angle_deg)) return joined(name, " ", angle_deg, " is not finite");
  if (angle_deg >= lowest_deg - kAngleRounding_deg && angle_deg <= highest_deg + kAngleRounding_deg) return "";
  return joined(name, " ", shortest_text(angle_deg), " is outside [", lowest_deg, ", ", highest_deg, "] degrees");
}

/// `angle_deg` within the bounds, if it is outside by rounding.
double rounded_inwards(double angle_deg, double lowest_deg, double highest_deg) {
  if (angle_deg < lowest_deg && angle_deg >= lowest_deg - kAngleRounding_deg) return lowest_deg;
  if (angle_deg > highest_deg && angle_deg <= highest_deg + kAngleRounding_deg) return highest_deg;
  return angle_deg;
}

constexpr double kLowestTheta_deg = -360, kHighestTheta_deg = 720, kLowestPhi_deg = 0, kHighestPhi_deg = 90;

}  // namespace

CameraPose without_rounding(const CameraPose& pose) {
  return {rounded_inwards(pose.theta_deg, kLowestTheta_deg, kHighestTheta_deg),
          rounded_inwards(pose.phi_deg, kLowestPhi_deg, kHighestPhi_deg)};
}

std::string pose_problem(const CameraPose& pose) {
  const std::string theta = angle_problem("theta", pose.theta_deg, kLowestTheta_deg, kHighestTheta_deg);
  return theta.empty() ? angle_problem("phi", pose.phi_deg, kLowestPhi_deg, kHighestPhi_deg) : theta;
}

}  // namespace svnet
