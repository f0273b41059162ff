#pragma once
#include <span>
#include <vector>

#include "frame/frame_inputs.h"

namespace svnet::frame {

/// The shapes of the top views that a head was fitted to: mean and standard deviation of each of their shape_numbers(),
/// and the largest distance() of one of them.
struct SeenShapes {
  std::vector<double> mean, deviation;
  double limit = 0;
};

/// What a head knows of a top view besides the camera pose: in a frame with an axis E, S, F and, with depth, T, W of
/// pose_inputs.h, NaN if not known; in a frame with turns the mean of each component over the turns. `features` are
/// those of frame_inputs.h. Throws Error unless there are feature_count() of them.
std::vector<double> shape_numbers(const FrameSpec& spec, std::span<const float> features);

/// Writes the same numbers, shape_number_count() of them. Allocates nothing.
void shape_numbers(const FrameSpec& spec, std::span<const float> features, std::span<double> numbers);

/// How many shape_numbers() there are.
Index shape_number_count(const FrameSpec& spec);

/// Of top views with these shape_numbers(). A number that is known of fewer than two of them, or equal in all, has mean
/// and deviation 0. Throws Error if there are no top views.
SeenShapes seen_shapes(const std::vector<std::vector<double>>& numbers);

/// The root of the mean of ((number - mean) / deviation)² over the numbers that are known and have a deviation; 0 if
/// there are none.
double distance(const SeenShapes& seen, std::span<const double> numbers);

/// The share of a head's terms of the shape that counts for a top view: 1 up to the limit, limit / distance above it,
/// so that a prediction shrinks to what holds for every object: the terms of φ and of the axis. 1 if nothing is known
/// of the top views that the head was fitted to.
double trust(const SeenShapes& seen, std::span<const double> numbers);

}  // namespace svnet::frame
