#pragma once
#include <span>

#include "image/image.h"
#include "view/camera_pose.h"

namespace svnet {

/// The half-sphere of camera poses seen from above (view/half_sphere_canvas.h).
/// One dot per pose, from dark blue (the lowest score) through green to yellow (the highest); the best one is ringed in
/// red. Of dots that overlap, the one with the higher score lies on top. Throws Error unless there are as many finite
/// scores as poses, at least one, and all poses are in range.
Image half_sphere_plot(std::span<const CameraPose> poses, std::span<const float> scores);

}  // namespace svnet
