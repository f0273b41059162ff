#pragma once
#include <span>
#include <vector>

#include "image/image.h"
#include "view/pose.h"

namespace svnet {

/// The half-sphere from above (view/half_sphere_canvas.h) with a filled dot for each pose that can be reached and an
/// empty one for each that cannot.
Image pose_plot(std::span<const Pose> poses, const std::vector<bool>& reachable);

}  // namespace svnet
