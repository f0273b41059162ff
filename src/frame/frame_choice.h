#pragma once
#include "base/enum_names.h"

namespace svnet::frame {

/// In which frame a head sees the top view:
///   camera  as it was taken: features of the top image, and θ and φ
///   axis    the object's own: its principal axis (object_axis.h), and θ from there (pose_inputs.h); no backbone
enum class FrameChoice { camera, axis };
constexpr auto enum_table(FrameChoice) {
  return std::to_array<EnumName<FrameChoice>>({{FrameChoice::camera, "camera"}, {FrameChoice::axis, "axis"}});
}

/// What a head knows from the depth of the top view:
///   none     nothing
///   heights  how the object stands above the table (heights.h)
enum class DepthChoice { none, heights };
constexpr auto enum_table(DepthChoice) {
  return std::to_array<EnumName<DepthChoice>>({{DepthChoice::none, "none"}, {DepthChoice::heights, "heights"}});
}

}  // namespace svnet::frame
