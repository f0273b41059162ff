#include "view/half_sphere_canvas.h"

#include <numbers>

namespace svnet::view {
namespace {

constexpr Index kSize_px = 512;
constexpr double kCentre_px = kSize_px / 2.0, kRim_px = 232;
constexpr Colour kGrid{214, 214, 214}, kRim{120, 120, 120};

}  // namespace

Colour mixed(const Colour& a, const Colour& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

HalfSphereCanvas::HalfSphereCanvas()
    : image_{kSize_px, kSize_px, std::vector<std::uint8_t>(kSize_px * kSize_px * 3, 255)} {
  for (int theta_deg = 0; theta_deg < 360; theta_deg += 45) spoke(kGrid, theta_deg);
  const Point centre{kCentre_px, kCentre_px};
  for (int phi_deg = 15; phi_deg < 90; phi_deg += 15) ring(kGrid, centre, kRim_px * (90 - phi_deg) / 90, 1);
  ring(kRim, centre, kRim_px, 2);
}

HalfSphereCanvas::Point HalfSphereCanvas::place_of(const CameraPose& pose) {
  const double radius = kRim_px * (90 - pose.phi_deg) / 90, theta = pose.theta_deg * std::numbers::pi / 180;
  return {kCentre_px + radius * std::cos(theta), kCentre_px - radius * std::sin(theta)};
}

/// Paints a shape with antialiased edges. `distance` gives the signed distance in pixels from the shape's edge,
/// negative inside. The shape lies within `reach_px` of `centre`.
template <class Distance>
void HalfSphereCanvas::paint(const Colour& colour, Point centre, double reach_px, const Distance& distance) {
  const auto pixel_at = [](double x_px) { return std::clamp(static_cast<Index>(x_px), Index{0}, kSize_px); };
  const Index top = pixel_at(centre.y_px - reach_px - 2), bottom = pixel_at(centre.y_px + reach_px + 2),
              left = pixel_at(centre.x_px - reach_px - 2), right = pixel_at(centre.x_px + reach_px + 2);
  for (Index y = top; y < bottom; ++y)
    for (Index x = left; x < right; ++x) {
      const double cover =
          std::clamp(0.5 - distance(Point{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}), 0.0, 1.0);
      if (cover == 0) continue;
      std::uint8_t* pixel = &image_.rgb[static_cast<std::size_t>(3 * (y * kSize_px + x))];
      const Colour now = mixed(
          {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])}, colour, cover);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::lround(now[c]));
    }
}

void HalfSphereCanvas::disc(const Colour& colour, const CameraPose& pose, double radius_px) {
  const Point centre = place_of(pose);
  paint(colour, centre, radius_px,
        [&](Point p) { return std::hypot(p.x_px - centre.x_px, p.y_px - centre.y_px) - radius_px; });
}

void HalfSphereCanvas::circle(const Colour& colour, const CameraPose& centre, double radius_px, double width_px) {
  ring(colour, place_of(centre), radius_px, width_px);
}

void HalfSphereCanvas::ring(const Colour& colour, Point centre, double radius_px, double width_px) {
  paint(colour, centre, radius_px + width_px, [&](Point p) {
    return std::abs(std::hypot(p.x_px - centre.x_px, p.y_px - centre.y_px) - radius_px) - width_px / 2;
  });
}

/// From the centre to the rim.
void HalfSphereCanvas::spoke(const Colour& colour, double theta_deg) {
  const Point end = place_of({theta_deg, 0});
  const double dx = (end.x_px - kCentre_px) / kRim_px, dy = (end.y_px - kCentre_px) / kRim_px;
  paint(colour, {kCentre_px, kCentre_px}, kRim_px, [&](Point p) {
    const double x = p.x_px - kCentre_px, y = p.y_px - kCentre_px, along = std::clamp(x * dx + y * dy, 0.0, kRim_px);
    return std::hypot(x - along * dx, y - along * dy) - 0.5;
  });
}

}  // namespace svnet::view
