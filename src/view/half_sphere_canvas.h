#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "image/image.h"
#include "view/pose.h"

namespace svnet {

using Colour = std::array<double, 3>;  // red, green and blue in [0, 255]

/// `share` of b, the rest of a.
Colour mixed(const Colour& a, const Colour& b, double share);

/// A picture of the half-sphere of camera poses seen from above, 512x512 on white: the top view in the centre, the
/// horizon at the rim, elevations evenly between (thin circles every 15°); azimuth 0° to the right, counter-clockwise
/// (spokes every 45°). Shapes are drawn over one another with soft edges.
class HalfSphereCanvas {
 public:
  HalfSphereCanvas();

  void disc(const Colour&, const Pose& centre, double radius_px);
  void circle(const Colour&, const Pose& centre, double radius_px, double width_px);

  Image take() { return std::move(image_); }

 private:
  struct Point {
    double x_px, y_px;
  };
  static Point place_of(const Pose&);
  template <class Distance>
  void paint(const Colour&, Point centre, double reach_px, const Distance&);
  void spoke(const Colour&, double theta_deg);
  void ring(const Colour&, Point centre, double radius_px, double width_px);

  Image image_;
};

}  // namespace svnet
