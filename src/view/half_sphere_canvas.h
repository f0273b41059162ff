#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "image/image.h"
#include "view/camera_pose.h"

namespace svnet::view {

using Colour = std::array<double, 3>;  // red, green and blue in [0, 255]

/// `share` of b, the rest of a.
Colour mixed(const Colour& a, const Colour& b, double share);

/// An image (512x512, white) of the half-sphere of camera poses seen from above. The centre is the top view, the rim
/// the horizon, and the distance from the centre is linear in the elevation (thin circles every 15°). Azimuth 0° points
/// to the right and grows counter-clockwise (spokes every 45°). Later shapes cover earlier ones; edges are antialiased.
class HalfSphereCanvas {
 public:
  HalfSphereCanvas();

  void disc(const Colour&, const CameraPose& centre, double radius_px);
  void circle(const Colour&, const CameraPose& centre, double radius_px, double width_px);

  Image take() { return std::move(image_); }

 private:
  struct Point {
    double x_px, y_px;
  };
  static Point place_of(const CameraPose&);
  template <class Distance>
  void paint(const Colour&, Point centre, double reach_px, const Distance&);
  void spoke(const Colour&, double theta_deg);
  void ring(const Colour&, Point centre, double radius_px, double width_px);

  Image image_;
};

}  // namespace svnet::view
