#include "view/reachability.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svnet {
namespace {

Eigen::Vector3d direction(const Pose& pose) {
  const double theta = pose.theta_deg * std::numbers::pi / 180, phi = pose.phi_deg * std::numbers::pi / 180;
  return {std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi)};
}

}  // namespace

Reachable listed_poses(std::vector<Pose> poses, double tolerance_deg) {
  // The chord, because the arc's cosine has no digits left for small angles.
  const double chord = 2 * std::sin(tolerance_deg * std::numbers::pi / 360);
  return [poses = std::move(poses), chord](const Pose& pose, const Eigen::Isometry3d&) {
    return std::any_of(poses.begin(), poses.end(),
                       [&](const Pose& listed) { return (direction(listed) - direction(pose)).norm() <= chord; });
  };
}

}  // namespace svnet
