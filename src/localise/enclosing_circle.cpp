#include "localise/enclosing_circle.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace svnet::localise {
namespace {

/// Points along the rim of the convex hull, about `spacing` apart.
std::vector<cv::Point2d> rim(const std::vector<cv::Point2f>& points, double spacing) {
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  std::vector<cv::Point2d> result;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const cv::Point2d from = hull[i], side = cv::Point2d(hull[(i + 1) % hull.size()]) - from;
    const int parts = std::max(1, static_cast<int>(std::lround(cv::norm(side) / spacing)));
    for (int k = 0; k < parts; ++k) result.push_back(from + side * k / parts);
  }
  return result;
}

/// The soft radius log Σ exp(|p - c|) around a centre c, its gradient and second derivatives, in units of softness.
struct SoftRadius {
  double value = 0;
  cv::Vec2d gradient;
  cv::Matx22d curvature;
};

SoftRadius soft_radius(const std::vector<cv::Point2d>& points, const cv::Point2d& centre, double softness) {
  double furthest = 0, sum = 0;
  for (const cv::Point2d& p : points) furthest = std::max(furthest, cv::norm(p - centre) / softness);
  SoftRadius result;
  for (const cv::Point2d& p : points) {
    const cv::Vec2d step = (centre - p) / softness;
    const double distance = std::max(cv::norm(step), 1e-6), weight = std::exp(distance - furthest);
    const cv::Vec2d outwards = step / distance;
    sum += weight;
    result.gradient += weight * outwards;
    result.curvature += weight * (outwards * outwards.t() * (1 - 1 / distance) + cv::Matx22d::eye() * (1 / distance));
  }
  result.value = furthest + std::log(sum);
  result.gradient /= sum;
  result.curvature = result.curvature * (1 / sum) - result.gradient * result.gradient.t();
  return result;
}

}  // namespace

cv::Point2d soft_enclosing_centre(const std::vector<cv::Point2f>& points, double softness) {
  constexpr int kMostSteps = 100;
  constexpr double kLongest = 4, kShortest = 1e-4;  // of a step, in units of softness
  const std::vector<cv::Point2d> outline = rim(points, 2 * softness);
  cv::Point2f exact;
  float radius = 0;
  cv::minEnclosingCircle(points, exact, radius);

  // Newton's method; the soft radius is convex.
  cv::Point2d centre = exact;
  SoftRadius at = soft_radius(outline, centre, softness);
  for (int i = 0; i < kMostSteps; ++i) {
    cv::Vec2d step = (at.curvature + cv::Matx22d::eye() * 1e-9).solve(-at.gradient, cv::DECOMP_LU);
    if (const double length = cv::norm(step); length > kLongest) step *= kLongest / length;
    SoftRadius next;
    while (cv::norm(step) > kShortest) {
      next = soft_radius(outline, centre + cv::Point2d(step * softness), softness);
      if (next.value < at.value) break;
      step *= 0.5;
    }
    if (cv::norm(step) <= kShortest) break;
    centre += cv::Point2d(step * softness);
    at = next;
  }
  return centre;
}

}  // namespace svnet::localise
