#pragma once
#include <array>
#include <span>
#include <vector>

#include "frame/frame_choice.h"
#include "frame/heights.h"
#include "frame/object_axis.h"
#include "frame/pose_inputs.h"
#include "image/depth_image.h"
#include "image/image.h"

namespace svnet::frame {

/// All that a head in the frame `axis` knows of a top view.
struct TopFrame {
  ObjectAxis axis;
  Heights heights;
};

/// Measures a top view. With `depth` the silhouette is what stands above the table, otherwise what differs from it in
/// colour; heights are known only with depth, which need not have the image's resolution. Throws Error as silhouette_of
/// and heights_of do.
TopFrame top_frame(const Image& top_image, const DepthImage* depth = nullptr);

/// A TopFrame as floats: the kind of the axis (its index), direction, elongation, skew, fill, length, width; whether
/// heights are known (0 or 1), measured, height, width, mean height, flatness, footprint, volume.
inline constexpr std::size_t kTopFrameSize = 15;
using TopFrameValues = std::array<float, kTopFrameSize>;
TopFrameValues to_values(const TopFrame& frame);
/// The opposite of to_values. Throws Error unless the values are ones that it can return.
TopFrame from_values(std::span<const float, kTopFrameSize> values);

/// The pose inputs of a head in the frame `axis`.
constexpr PoseInputOptions input_options(DepthChoice depth) {
  return {.axis = true, .shape = true, .heights = depth == DepthChoice::heights};
}

/// How many pose inputs there are.
Index pose_input_count(const PoseInputOptions& options);

}  // namespace svnet::frame
