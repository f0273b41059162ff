#include "top_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace svnet::frame {
namespace {

/// The point in the shape's own axes, if the shape is turned counter-clockwise by that angle.
std::pair<double, double> own(double x, double y, double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)};
}

/// The pixel's point, in shares of the inscribed circle's radius.
std::pair<double, double> point_of(Index row, Index column, Index height, Index width) {
  const double radius = static_cast<double>(std::min(height, width)) / 2;
  return {(static_cast<double>(column) - static_cast<double>(width - 1) / 2) / radius,
          (static_cast<double>(row) - static_cast<double>(height - 1) / 2) / radius};
}

/// Where the value at (row, column) of a square turned by a quarter counter-clockwise comes from.
std::size_t source_of(Index row, Index column, Index side) {
  return static_cast<std::size_t>(column * side + (side - 1 - row));
}

template <class Value>
std::vector<Value> quarter_turned_values(const std::vector<Value>& values, Index side, std::size_t channels) {
  std::vector<Value> turned(values.size());
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column)
      for (std::size_t c = 0; c < channels; ++c)
        turned[static_cast<std::size_t>(row * side + column) * channels + c] =
            values[source_of(row, column, side) * channels + c];
  return turned;
}

}  // namespace

Shape ellipse(double length, double width, double angle_deg, double centre_x, double centre_y) {
  return [=](double x, double y) {
    const auto [u, v] = own(x - centre_x, y - centre_y, angle_deg);
    return 4 * u * u / (length * length) + 4 * v * v / (width * width) <= 1;
  };
}

Shape wedge(double length, double base, double angle_deg) {
  return [=](double x, double y) {
    const auto [u, v] = own(x, y, angle_deg);
    const double along = u / length + 0.5;
    return along >= 0 && along <= 1 && 2 * std::abs(v) <= base * along;
  };
}

Shape letter_t(double length, double angle_deg) {
  return [=](double x, double y) {
    const auto [u, v] = own(x, y, angle_deg);
    const double along = u / length + 0.5;
    return along >= 0 && along <= 1 && std::abs(v) <= (along > 0.8 ? 0.25 : 0.06) * length;
  };
}

Shape any_of(std::vector<Shape> shapes) {
  return [shapes = std::move(shapes)](double x, double y) {
    return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) { return shape(x, y); });
  };
}

Image picture_of(const Shape& shape, const Look& look) {
  constexpr std::array<double, 3> kTable{170, 150, 125}, kObject{150, 50, 45};
  constexpr double kShadowOffset = 0.1;
  constexpr int kSamples = 3;
  std::mt19937 random(look.seed);
  std::normal_distribution<double> normal;
  Image image{look.height, look.width, {}};
  const double step = 2.0 / static_cast<double>(std::min(look.height, look.width)) / kSamples;
  for (Index row = 0; row < look.height; ++row)
    for (Index column = 0; column < look.width; ++column) {
      const auto [x, y] = point_of(row, column, look.height, look.width);
      int object = 0, shadow = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double u = x + step * (i % kSamples - kSamples / 2), v = y + step * (i / kSamples - kSamples / 2);
        if (shape(u, v))
          ++object;
        else if (shape(u - kShadowOffset, v + kShadowOffset))
          ++shadow;
      }
      constexpr double kAll = kSamples * kSamples;
      for (std::size_t c = 0; c < 3; ++c) {
        const double table = (kTable[c] + look.gradient * x) * (1 - look.shadow * shadow / kAll);
        const double level = table + (kObject[c] - table) * object / kAll + look.noise * normal(random);
        image.rgb.push_back(static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, 255.0)));
      }
    }
  return image;
}

DepthImage depth_of(const Shape& shape, const std::function<double(double x, double y)>& height_m, double tilt_m) {
  constexpr Index kPixels = 224;
  DepthImage depth{kPixels, kPixels, {}, 0.001};
  for (Index row = 0; row < kPixels; ++row)
    for (Index column = 0; column < kPixels; ++column) {
      const auto [x, y] = point_of(row, column, kPixels, kPixels);
      // A tilted plane: its inverse depth is affine in the pixel.
      const double table_m = 1 / (1 / 0.5 + (1 / (0.5 + tilt_m) - 1 / 0.5) * x);
      depth.metres.push_back(static_cast<float>(shape(x, y) ? table_m - height_m(x, y) : table_m));
    }
  return depth;
}

Image quarter_turned(const Image& image) {
  return {image.width, image.height, quarter_turned_values(image.rgb, image.width, 3)};
}

DepthImage quarter_turned(const DepthImage& depth) {
  return {depth.width, depth.height, quarter_turned_values(depth.metres, depth.width, 1), depth.unit_m};
}

Grid<std::uint8_t> quarter_turned(const Grid<std::uint8_t>& grid) { return quarter_turned_values(grid, kSide, 1); }

double between_directions(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360.0)); }

double between_axes(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 180.0)); }

}  // namespace svnet::frame
