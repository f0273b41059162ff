#include "frame/turned_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "frame/image_check.h"

namespace svnet::frame {
namespace {

constexpr Index kChannels = 3;
using Colour = std::array<std::uint8_t, 3>;

void check_pixels(const Image& image) { check_image("image", image.height, image.width, image.rgb.size(), kChannels); }

std::uint8_t* pixel(Image& image, Index row, Index column) {
  return image.rgb.data() + (row * image.width + column) * kChannels;
}
const std::uint8_t* pixel(const Image& image, Index row, Index column) {
  return image.rgb.data() + (row * image.width + column) * kChannels;
}

Image empty_square(Index side) {
  return {side, side, std::vector<std::uint8_t>(static_cast<std::size_t>(side * side * kChannels))};
}

/// The squared distance of a pixel's middle from the middle of the square, in half pixels: an integer.
Index squared_radius_of(Index side, Index row, Index column) {
  const Index y = 2 * row - (side - 1), x = 2 * column - (side - 1);
  return y * y + x * x;
}

/// The mean colour of the rim; the middle pixel of images that are too small to have one.
Colour rim_colour(const Image& square) {
  const Index side = square.width;
  const double full = static_cast<double>(side * side);
  std::array<Index, 3> sums{};
  Index count = 0;
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column) {
      const auto radius = static_cast<double>(squared_radius_of(side, row, column));
      if (radius < 0.89 * 0.89 * full || radius > 0.99 * 0.99 * full) continue;
      ++count;
      for (std::size_t c = 0; c < 3; ++c) sums[c] += pixel(square, row, column)[c];
    }
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = count > 0 ? static_cast<std::uint8_t>((2 * sums[c] + count) / (2 * count))
                          : pixel(square, side / 2, side / 2)[c];
  return colour;
}

/// The weights of the pixels at -1, 0, 1 and 2 for a point `t` in [0, 1) after the pixel 0.
std::array<double, 4> keys_weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (-t + 2 * t2 - t3), 0.5 * (2 - 5 * t2 + 3 * t3), 0.5 * (t + 4 * t2 - 3 * t3), 0.5 * (t3 - t2)};
}

/// The pixels of an image, one vector of four each: (height, width, 4). In f64, since the sums of an image and of its
/// quarter turn, which are taken in other orders, must round to the same levels.
constexpr Index kLanes = 4;
std::vector<double> lanes_of(const Image& image) {
  const Index pixels = image.height * image.width;
  std::vector<double> lanes(static_cast<std::size_t>(pixels * kLanes));
  for (Index i = 0; i < pixels; ++i)
    for (Index c = 0; c < kChannels; ++c) lanes[i * kLanes + c] = image.rgb[i * kChannels + c];
  return lanes;
}

/// The colour at a point of a square with these lanes, in pixels from the middle of the upper left one: at least -1/2.
Colour interpolated(const std::vector<double>& lanes, Index side, double y, double x) {
  const Index row = static_cast<Index>(y + 1) - 1, column = static_cast<Index>(x + 1) - 1;  // rounded down
  const std::array<double, 4> down = keys_weights(y - static_cast<double>(row)),
                              across = keys_weights(x - static_cast<double>(column));
  std::array<double, kLanes> sums{};
  for (Index i = 0; i < 4; ++i) {
    const double* line = lanes.data() + std::clamp<Index>(row + i - 1, 0, side - 1) * side * kLanes;
    std::array<double, kLanes> of_row{};
    for (Index j = 0; j < 4; ++j) {
      const double* pixel = line + std::clamp<Index>(column + j - 1, 0, side - 1) * kLanes;
      for (std::size_t c = 0; c < kLanes; ++c) of_row[c] += across[static_cast<std::size_t>(j)] * pixel[c];
    }
    for (std::size_t c = 0; c < kLanes; ++c) sums[c] += down[static_cast<std::size_t>(i)] * of_row[c];
  }
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(std::clamp(sums[c] + 0.5, 0.0, 255.0));
  return colour;
}

}  // namespace

Image quarter_turned_square(const Image& image, int quarters) {
  check_pixels(image);
  const Index side = std::min(image.height, image.width), end = side - 1;
  const Index top = (image.height - side) / 2, left = (image.width - side) / 2;
  // Where the first pixel comes from, and the steps to those of the next row and column.
  const Index width = image.width;
  const Index corners[] = {0, end, end * width + end, end * width}, downs[] = {width, -1, -width, 1},
              rights[] = {1, width, -1, -width};
  const std::uint8_t* const first = pixel(image, top, left) + corners[quarters] * kChannels;
  const Index down = downs[quarters] * kChannels, right = rights[quarters] * kChannels;
  Image square = empty_square(side);
  std::uint8_t* to = square.rgb.data();
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column, to += kChannels) {
      const std::uint8_t* from = first + row * down + column * right;
      to[0] = from[0];
      to[1] = from[1];
      to[2] = from[2];
    }
  return square;
}

Image turned_image(const Image& top_image, double theta_deg) {
  check_pixels(top_image);
  check(std::isfinite(theta_deg), "[frame] the angle of the camera is not finite: ", theta_deg);
  // Whole quarters first, which are exact: the rest, in [-45, 45), is the same for angles that are quarters apart.
  const double turn = std::fmod(90 - theta_deg, 360.0);
  const double quarters = std::floor((turn + 45) / 90), rest_rad = (turn - 90 * quarters) * std::numbers::pi / 180;
  const Image square = quarter_turned_square(top_image, (static_cast<int>(quarters) % 4 + 4) % 4);

  const Index side = square.width;
  const Colour fill = rim_colour(square);
  const double middle = static_cast<double>(side - 1) / 2, cosine = std::cos(rest_rad), sine = std::sin(rest_rad);
  const std::vector<double> lanes = rest_rad == 0 ? std::vector<double>() : lanes_of(square);
  Image turned = empty_square(side);
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column) {
      const double y = static_cast<double>(row) - middle, x = static_cast<double>(column) - middle;
      Colour colour = fill;
      if (squared_radius_of(side, row, column) <= side * side) {
        if (rest_rad == 0)
          std::copy_n(pixel(square, row, column), kChannels, colour.begin());
        else
          colour = interpolated(lanes, side, middle + (y * cosine + x * sine), middle + (x * cosine - y * sine));
      }
      std::copy_n(colour.begin(), kChannels, pixel(turned, row, column));
    }
  return turned;
}

Image mirrored(const Image& image) {
  check_pixels(image);
  Image result{image.height, image.width, std::vector<std::uint8_t>(image.rgb.size())};
  for (Index row = 0; row < image.height; ++row) {
    const std::uint8_t* from = pixel(image, row, 0);
    std::uint8_t* to = pixel(result, row, 0);
    for (Index left = 0, right = (image.width - 1) * kChannels; right >= 0; left += kChannels, right -= kChannels) {
      to[left] = from[right];
      to[left + 1] = from[right + 1];
      to[left + 2] = from[right + 2];
    }
  }
  return result;
}

}  // namespace svnet::frame
