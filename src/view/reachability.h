#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "view/pose.h"

namespace svnet {

/// Whether the robot can bring its camera to a place: asked with the pose on the half-sphere and the camera's own pose
/// in the world (optical frame). An inverse-kinematics solver fits here.
using Reachable = std::function<bool(const Pose&, const Eigen::Isometry3d& camera_to_world)>;

/// Reachable are the listed poses, to within `tolerance_deg` of arc between the directions.
Reachable listed_poses(std::vector<Pose> poses, double tolerance_deg = 0.5);

}  // namespace svnet
