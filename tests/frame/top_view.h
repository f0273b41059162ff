#pragma once
#include <functional>
#include <vector>

#include "frame/silhouette.h"
#include "image/depth_image.h"
#include "image/image.h"

// Top views that are made up for the tests. Points are in shares of the image's inscribed circle's radius from its
// middle, x to the right and y downwards.
namespace svnet::frame {

using Shape = std::function<bool(double x, double y)>;

Shape ellipse(double length, double width, double angle_deg, double x = 0, double y = 0);
/// A wedge that points to the left at 0 degrees: a triangle, whose heavy end is its base at the right.
Shape wedge(double length, double base, double angle_deg);
/// A hammer with its head at the right at 0 degrees.
Shape letter_t(double length, double angle_deg);
Shape any_of(std::vector<Shape> shapes);

struct Look {
  Index height = 224, width = 224;
  double gradient = 20;  // of the table, in levels from the middle to the right border
  double noise = 2;      // sd in levels, of each pixel
  double shadow = 0;     // how much darker a shadow is, a share; it falls to the upper right, a tenth of the radius
  unsigned seed = 1;     // of the noise
};

/// A brown table with a red object of that shape.
Image picture_of(const Shape&, const Look& = {});

/// Depth of a table at 0.5 m that falls away to the right by `tilt_m`, and of an object of a height that depends on the
/// point.
DepthImage depth_of(const Shape&, const std::function<double(double x, double y)>& height_m, double tilt_m = 0);

/// The image, depth or grid turned by a quarter turn counter-clockwise.
Image quarter_turned(const Image&);
DepthImage quarter_turned(const DepthImage&);
Grid<std::uint8_t> quarter_turned(const Grid<std::uint8_t>&);

/// The angle between two directions in degrees, [0, 180]; between two axes, [0, 90].
double between_directions(double a_deg, double b_deg);
double between_axes(double a_deg, double b_deg);

}  // namespace svnet::frame
