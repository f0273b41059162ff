#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "view/camera_pose.h"

namespace svnet::view {

/// Whether the robot can bring its camera to a camera pose, whose optical frame is `camera_to_world`. An
/// inverse-kinematics solver can be used here.
using Reachable = std::function<bool(const CameraPose&, const Eigen::Isometry3d& camera_to_world)>;

/// True for poses whose direction is at most `tolerance_deg` away from that of a listed one.
Reachable listed_poses(std::vector<CameraPose> poses, double tolerance_deg = 0.5);

}  // namespace svnet::view
