#include "predict/half_sphere_plot.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "predict/predictor.h"
#include "view/colour_scale.h"
#include "view/half_sphere_canvas.h"

namespace svnet::predict {
using view::Colour;

namespace {

constexpr double kDot_px = 11;
constexpr Colour kOutline{40, 40, 40}, kBest{214, 39, 40};

}  // namespace

Image half_sphere_plot(std::span<const view::CameraPose> poses, std::span<const float> scores) {
  check(poses.size() == scores.size(), "[plot] there are ", poses.size(), " poses and ", scores.size(), " scores");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string problem = pose_problem(poses[i]);
    check(problem.empty(), "[plot] pose ", i, ": ", problem);
    check(std::isfinite(scores[i]), "[plot] score ", i, " is ", scores[i], ", not a finite number");
  }
  const std::size_t best = best_view(scores);
  const auto [low, high] = std::minmax_element(scores.begin(), scores.end());
  const double lowest = *low, range = static_cast<double>(*high) - lowest;

  view::HalfSphereCanvas canvas;
  std::vector<std::size_t> order = best_first(scores);
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    canvas.disc(kOutline, clamped_pose(poses[*i]), kDot_px + 1);
    canvas.disc(view::scale_colour(range > 0 ? (scores[*i] - lowest) / range : 1), clamped_pose(poses[*i]), kDot_px);
  }
  canvas.circle(kBest, clamped_pose(poses[best]), kDot_px + 5, 4);
  return canvas.take();
}

}  // namespace svnet::predict
