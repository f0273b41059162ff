#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace svnet::localise {

/// The centre of a smallest enclosing circle that is robust against errors of the points.
///
/// The exact circle is determined by two or three points. If these nearly lie on a line, an error of one of them moves
/// the centre several times as far. Here all points on the rim of the convex hull count: the centre c minimises
/// Σ exp(|p - c| / softness) over the rim. `softness` is about the error of the points, in their unit; as it tends to 0
/// the result tends to the exact centre. Requires at least one point and softness > 0.
cv::Point2d soft_enclosing_centre(const std::vector<cv::Point2f>& points, double softness);

}  // namespace svnet::localise
