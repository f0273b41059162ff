#pragma once
#include <array>
#include <span>
#include <vector>

#include "frame/frame_inputs.h"
#include "image/image.h"

// What a head sees that ranks the camera poses for the next view of an object, given views that were taken. For a
// candidate v and a taken view u, with x, c, E, S, F of pose_inputs.h, E, S, F measured in the picture of u:
//   frame_inputs() of v
//   relation  A, A², P cos Δθ, P cos 2Δθ, |x_v − x_u| / 2, x_v x_u
//             A = min(the angle between both directions, 90°) / 90°, P = c_v c_u, Δθ = θ_v − θ_u
//   second    each of E, S, F, times each of x_v, A, P cos Δθ; 0 if the picture does not show one whole object
// For several taken views each input is the mean over them.
namespace svnet::frame {

/// What the picture of a view shows of the object's shape: E, S, F; all 0 if it does not show one whole object. Unlike
/// a top view, the picture may be taken from any camera pose.
inline constexpr std::size_t kViewShapeSize = 3;
using ViewShape = std::array<float, kViewShapeSize>;

/// Throws Error for an image without pixels.
ViewShape view_shape(const Image& picture);

struct TakenView {
  view::CameraPose pose;
  ViewShape shape;
};

Index next_input_count(const FrameSpec& spec);

/// The group of each input.
std::vector<InputGroup> next_input_groups(const FrameSpec& spec);

/// The inputs of many candidates for one object. Keeps references to the features and the taken views.
class NextInputs {
 public:
  /// As FrameInputs. Throws Error also if no view was taken, and if a shape is not finite or a pose is out of range.
  NextInputs(const FrameSpec& spec, std::span<const float> features, std::span<const TakenView> taken,
             double trust = 1);

  /// Writes the inputs of a candidate. Requires next_input_count() elements. Throws Error for a pose that is out of
  /// range. Allocates nothing.
  void write(const view::CameraPose& pose, std::span<double> inputs) const;

 private:
  FrameInputs of_pose_;
  std::size_t count_;  // of the inputs of FrameInputs
  std::span<const TakenView> taken_;
};

}  // namespace svnet::frame
