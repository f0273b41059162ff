#include "predict/half_sphere_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "predict/predictor.h"

namespace svnet {
namespace {

constexpr Index kSize_px = 512;
constexpr double kCentre_px = kSize_px / 2.0, kRim_px = 232, kDot_px = 11;

using Colour = std::array<double, 3>;
constexpr Colour kGrid{214, 214, 214}, kRim{120, 120, 120}, kOutline{40, 40, 40}, kBest{214, 39, 40};
/// Of rising brightness, so that the order survives a grey print.
constexpr std::array<Colour, 5> kScale{{{48, 18, 92}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};

Colour mixed(const Colour& a, const Colour& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

/// The colour of a height in [0, 1].
Colour scale_colour(double height) {
  const double place = std::clamp(height, 0.0, 1.0) * (kScale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  return mixed(kScale[below], kScale[below + 1], place - static_cast<double>(below));
}

struct Point {
  double x_px, y_px;
};

Point place_of(const Pose& pose) {
  const double radius = kRim_px * (90 - pose.phi_deg) / 90, theta = pose.theta_deg * std::numbers::pi / 180;
  return {kCentre_px + radius * std::cos(theta), kCentre_px - radius * std::sin(theta)};
}

class Canvas {
 public:
  Canvas() : image_{kSize_px, kSize_px, std::vector<std::uint8_t>(kSize_px * kSize_px * 3, 255)} {}

  /// Paints where `distance`, in pixels from a shape's edge and negative inside it, is below 0, with soft edges. The
  /// shape lies within `reach_px` of `centre`.
  template <class Distance>
  void paint(const Colour& colour, Point centre, double reach_px, const Distance& distance) {
    const auto pixel_at = [](double x_px) { return std::clamp(static_cast<Index>(x_px), Index{0}, kSize_px); };
    const Index top = pixel_at(centre.y_px - reach_px - 2), bottom = pixel_at(centre.y_px + reach_px + 2),
                left = pixel_at(centre.x_px - reach_px - 2), right = pixel_at(centre.x_px + reach_px + 2);
    for (Index y = top; y < bottom; ++y)
      for (Index x = left; x < right; ++x) {
        const double cover =
            std::clamp(0.5 - distance(Point{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}), 0.0, 1.0);
        if (cover == 0) continue;
        std::uint8_t* pixel = &image_.rgb[static_cast<std::size_t>(3 * (y * kSize_px + x))];
        const Colour now =
            mixed({static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])}, colour,
                  cover);
        for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::lround(now[c]));
      }
  }

  void disc(const Colour& colour, Point centre, double radius_px) {
    paint(colour, centre, radius_px,
          [&](Point p) { return std::hypot(p.x_px - centre.x_px, p.y_px - centre.y_px) - radius_px; });
  }

  void circle(const Colour& colour, Point centre, double radius_px, double width_px) {
    paint(colour, centre, radius_px + width_px, [&](Point p) {
      return std::abs(std::hypot(p.x_px - centre.x_px, p.y_px - centre.y_px) - radius_px) - width_px / 2;
    });
  }

  /// From the centre to the rim.
  void spoke(const Colour& colour, double theta_deg) {
    const Point end = place_of({theta_deg, 0});
    const double dx = (end.x_px - kCentre_px) / kRim_px, dy = (end.y_px - kCentre_px) / kRim_px;
    paint(colour, {kCentre_px, kCentre_px}, kRim_px, [&](Point p) {
      const double x = p.x_px - kCentre_px, y = p.y_px - kCentre_px, along = std::clamp(x * dx + y * dy, 0.0, kRim_px);
      return std::hypot(x - along * dx, y - along * dy) - 0.5;
    });
  }

  Image take() { return std::move(image_); }

 private:
  Image image_;
};

}  // namespace

Image half_sphere_plot(std::span<const Pose> poses, std::span<const float> scores) {
  check(poses.size() == scores.size(), "[plot] there are ", poses.size(), " poses and ", scores.size(), " scores");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string problem = pose_problem(poses[i]);
    check(problem.empty(), "[plot] pose ", i, ": ", problem);
    check(std::isfinite(scores[i]), "[plot] score ", i, " is ", scores[i], ", not a finite number");
  }
  const std::size_t best = best_view(scores);
  const auto [low, high] = std::minmax_element(scores.begin(), scores.end());
  const double lowest = *low, range = static_cast<double>(*high) - lowest;

  Canvas canvas;
  const Point centre{kCentre_px, kCentre_px};
  for (int theta_deg = 0; theta_deg < 360; theta_deg += 45) canvas.spoke(kGrid, theta_deg);
  for (int phi_deg = 15; phi_deg < 90; phi_deg += 15) canvas.circle(kGrid, centre, kRim_px * (90 - phi_deg) / 90, 1);
  canvas.circle(kRim, centre, kRim_px, 2);
  std::vector<std::size_t> order = best_first(scores);
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    const Point place = place_of(poses[*i]);
    canvas.disc(kOutline, place, kDot_px + 1);
    canvas.disc(scale_colour(range > 0 ? (scores[*i] - lowest) / range : 1), place, kDot_px);
  }
  canvas.circle(kBest, place_of(poses[best]), kDot_px + 5, 4);
  return canvas.take();
}

}  // namespace svnet
