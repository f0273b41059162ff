#pragma once
#include <span>

#include "image/image.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// The half-sphere of camera poses seen from above (view/half_sphere_canvas.h) with a dot per pose. Colours go from
/// dark blue (lowest score) through green to yellow (highest); a red ring marks the best pose. Higher scores cover
/// lower ones. Throws Error unless there is at least one pose, a finite score for each, and all poses are in range.
Image half_sphere_plot(std::span<const view::CameraPose> poses, std::span<const float> scores);

}  // namespace svnet::predict
