#pragma once
#include <span>
#include <vector>

#include "image/image.h"
#include "view/camera_pose.h"

namespace svnet::view {

/// The half-sphere from above (view/half_sphere_canvas.h) with a filled dot for each reachable pose and an empty dot
/// for each other one. Requires poses.size() == reachable.size().
Image pose_plot(std::span<const CameraPose> poses, const std::vector<bool>& reachable);

}  // namespace svnet::view
