#pragma once
#include "base/enum_names.h"

namespace svnet::frame {

/// In which frame a head sees the top view:
///   camera       as it was taken: features of the top image, and θ and φ
///   axis         the object's own: its principal axis (object_axis.h), and θ from there (pose_inputs.h); no backbone
///   turned       the candidate camera's: features of the top image turned to it (turns.h), and φ
///   turned_axis  both of these
enum class FrameChoice { camera, axis, turned, turned_axis };
constexpr auto enum_table(FrameChoice) {
  return std::to_array<EnumName<FrameChoice>>({{FrameChoice::camera, "camera"},
                                               {FrameChoice::axis, "axis"},
                                               {FrameChoice::turned, "turned"},
                                               {FrameChoice::turned_axis, "turned_axis"}});
}

/// Whether the head knows the object's axis, and so can know its heights.
constexpr bool has_axis(FrameChoice frame) {
  switch (frame) {
    case FrameChoice::camera:
    case FrameChoice::turned:
      return false;
    case FrameChoice::axis:
    case FrameChoice::turned_axis:
      return true;
  }
  return false;
}

/// Whether the head sees the top image turned.
constexpr bool has_turns(FrameChoice frame) {
  switch (frame) {
    case FrameChoice::camera:
    case FrameChoice::axis:
      return false;
    case FrameChoice::turned:
    case FrameChoice::turned_axis:
      return true;
  }
  return false;
}

/// Whether a backbone makes features of the top image.
constexpr bool has_backbone(FrameChoice frame) { return frame == FrameChoice::camera || has_turns(frame); }

/// What a head knows from the depth of the top view:
///   none     nothing
///   heights  how the object stands above the table (heights.h)
enum class DepthChoice { none, heights };
constexpr auto enum_table(DepthChoice) {
  return std::to_array<EnumName<DepthChoice>>({{DepthChoice::none, "none"}, {DepthChoice::heights, "heights"}});
}

}  // namespace svnet::frame
