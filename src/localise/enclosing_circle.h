#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace svnet {

/// The centre of the smallest circle around points that are known to about `softness`, in the points' unit. Where three
/// points that nearly lie on a line hold the circle, an error of one of them moves the exact centre several times as
/// far. So here all points of the convex hull's rim have a say, e times less for each `softness` that they lie further
/// inside: the centre c minimises Σ exp(|p - c| / softness), which tends to the exact one where softness tends to 0.
/// Needs a point, and a softness above 0.
cv::Point2d soft_enclosing_centre(const std::vector<cv::Point2f>& points, double softness);

}  // namespace svnet
