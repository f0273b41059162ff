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

/// The colour at a point of the square, in pixels from the middle of the upper left one: at least -1/2.
Colour interpolated(const Image& square, double y, double x) {
  const Index row = static_cast<Index>(y + 1) - 1, column = static_cast<Index>(x + 1) - 1;  // rounded down
  const std::array<double, 4> down = keys_weights(y - static_cast<double>(row)),
                              across = keys_weights(x - static_cast<double>(column));
  std::array<Index, 4> rows{}, offsets{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Index step = static_cast<Index>(i) - 1;
    rows[i] = std::clamp<Index>(row + step, 0, square.height - 1);
    offsets[i] = std::clamp<Index>(column + step, 0, square.width - 1) * kChannels;
  }
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint8_t* pixels = pixel(square, rows[i], 0);
    for (std::size_t c = 0; c < 3; ++c)
      sums[c] += down[i] * (across[0] * pixels[offsets[0] + static_cast<Index>(c)] +
                            across[1] * pixels[offsets[1] + static_cast<Index>(c)] +
                            across[2] * pixels[offsets[2] + static_cast<Index>(c)] +
                            across[3] * pixels[offsets[3] + static_cast<Index>(c)]);
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
  Image square = empty_square(side);
  for (Index i = 0; i < side; ++i)
    for (Index j = 0; j < side; ++j) {
      Index row = i, column = j;
      for (int turn = 0; turn < quarters; ++turn) {
        const Index above = row;
        row = column;
        column = end - above;
      }
      std::copy_n(pixel(image, top + row, left + column), kChannels, pixel(square, i, j));
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
  Image turned = empty_square(side);
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column) {
      const double y = static_cast<double>(row) - middle, x = static_cast<double>(column) - middle;
      Colour colour = fill;
      if (squared_radius_of(side, row, column) <= side * side) {
        if (rest_rad == 0)
          std::copy_n(pixel(square, row, column), kChannels, colour.begin());
        else
          colour = interpolated(square, middle + (y * cosine + x * sine), middle + (x * cosine - y * sine));
      }
      std::copy_n(colour.begin(), kChannels, pixel(turned, row, column));
    }
  return turned;
}

Image mirrored(const Image& image) {
  check_pixels(image);
  Image result{image.height, image.width, std::vector<std::uint8_t>(image.rgb.size())};
  for (Index row = 0; row < image.height; ++row)
    for (Index column = 0; column < image.width; ++column)
      std::copy_n(pixel(image, row, image.width - 1 - column), kChannels, pixel(result, row, column));
  return result;
}

}  // namespace svnet::frame
