#pragma once
#include <span>
#include <vector>

#include "frame/frame_choice.h"
#include "frame/pose_inputs.h"
#include "frame/top_frame.h"

// What a head in a frame other than `camera` sees. Its features of a top view are, in this order:
//   if the frame has an axis   the 15 TopFrameValues
//   if it has turns            K values of each turn, (kTurns, K), in the order of turns()
// Its inputs for a camera pose are pose_inputs(), with the groups axis, shape and heights only if the frame has an
// axis; then, of the group turned, the K values of the turns under turn_weights(), and each of them times x.
namespace svnet::frame {

struct FrameSpec {
  FrameChoice frame = FrameChoice::axis;
  DepthChoice depth = DepthChoice::none;
  Index components = 0;  ///< K; 0 in a frame without turns
};

/// The number of features of a top view.
Index feature_count(const FrameSpec& spec);

/// The number of inputs of a camera pose.
Index input_count(const FrameSpec& spec);

/// The group of each input.
std::vector<InputGroup> input_groups(const FrameSpec& spec);

/// Throws Error unless there are feature_count() features.
void check_feature_count(const FrameSpec& spec, std::span<const float> features);

/// The inputs of a camera pose. Those of the groups shape, heights and turned are multiplied by `trust`
/// (seen_shapes.h). Throws Error for a pose that is out of range (view/camera_pose.h), unless there are
/// feature_count() features, and if the values of the axis are not ones that to_values can return.
std::vector<double> frame_inputs(const FrameSpec& spec, std::span<const float> features, const view::CameraPose& pose,
                                 double trust = 1);

}  // namespace svnet::frame
