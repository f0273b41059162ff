#include "view/reachability.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/camera.h"

namespace svnet::view {

Reachable listed_poses(std::vector<CameraPose> poses, double tolerance_deg) {
  // The chord, because the arc's cosine has no digits left for small angles.
  const double chord = 2 * std::sin(tolerance_deg * std::numbers::pi / 360);
  return [poses = std::move(poses), chord](const CameraPose& pose, const Eigen::Isometry3d&) {
    return std::any_of(poses.begin(), poses.end(),
                       [&](const CameraPose& listed) { return (outwards(listed) - outwards(pose)).norm() <= chord; });
  };
}

}  // namespace svnet::view
