#include "view/camera_pose.h"

#include <cmath>

#include "base/error.h"

namespace svnet {
namespace {

std::string angle_problem(const char* name, double angle_deg, double lowest_deg, double highest_deg) {
  if (!std::isfinite(angle_deg)) return joined(name, " ", angle_deg, " is not finite");
  if (angle_deg >= lowest_deg && angle_deg <= highest_deg) return "";
  return joined(name, " ", angle_deg, " is outside [", lowest_deg, ", ", highest_deg, "] degrees");
}

}  // namespace

std::string pose_problem(const CameraPose& pose) {
  const std::string theta = angle_problem("theta", pose.theta_deg, -360, 720);
  return theta.empty() ? angle_problem("phi", pose.phi_deg, 0, 90) : theta;
}

}  // namespace svnet
