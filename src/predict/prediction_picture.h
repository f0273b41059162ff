#pragma once
#include <span>

#include "image/depth_image.h"
#include "image/image.h"
#include "view/camera_pose.h"

namespace svnet::predict {

/// A prediction as a picture (624, 1232), with `chosen` (624, 1768): at the left the top image with the object's axis;
/// at the right the half-sphere of half_sphere_plot(), turned by half a turn so that it lies as in the top image
/// (azimuth 0 to the left, 90 down), with azimuths and elevations; then the scale of its colours; below, the best pose
/// and its score beside the top view's, if that is among the poses. `chosen`, if not nullptr, is the image that was
/// taken from the best pose; it stands at the right. With `depth` the axis is that of what stands above the table.
/// Throws Error as half_sphere_plot, and for an empty image.
Image prediction_picture(const Image& top, const DepthImage* depth, std::span<const view::CameraPose> poses,
                         std::span<const float> scores, const Image* chosen = nullptr);

}  // namespace svnet::predict
