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

/// The inputs of many camera poses for one top view: what depends on the top view alone is read once. Keeps a reference
/// to the features.
class FrameInputs {
 public:
  /// The inputs of the groups shape, heights and turned are multiplied by `trust` (seen_shapes.h). Throws Error unless
  /// there are feature_count() features, and if the values of the axis are not ones that to_values can return.
  FrameInputs(const FrameSpec& spec, std::span<const float> features, double trust = 1);

  /// Writes the inputs of a camera pose. Requires input_count() elements. Throws Error for a pose that is out of range
  /// (view/camera_pose.h). Allocates nothing.
  void write(const view::CameraPose& pose, std::span<double> inputs) const;

 private:
  void write_turned(const view::CameraPose& pose, std::span<double> inputs) const;

  PoseInputOptions options_;
  std::size_t components_;
  double trust_;
  TopFrame top_{};                // of a frame with an axis
  std::span<const float> turns_;  // (kTurns, components)
};

/// The inputs of one camera pose. Throws Error as FrameInputs does.
std::vector<double> frame_inputs(const FrameSpec& spec, std::span<const float> features, const view::CameraPose& pose,
                                 double trust = 1);

}  // namespace svnet::frame
