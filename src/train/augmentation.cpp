#include "train/augmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace svnet::train {
namespace {

/// Uniform in [-most, most).
double symmetric_uniform(RandomStream& random, double most) { return most * (2 * random.uniform() - 1); }

/// Between 1 / (1 + most) and 1 + most, evenly in the logarithm.
double factor(RandomStream& random, double most) { return std::exp(symmetric_uniform(random, std::log1p(most))); }

/// The source of a pixel: (x, y) = origin + column · right + row · down, in pixels of the source.
struct Placement {
  std::array<double, 2> origin, right, down;
};

Placement random_placement(const Augmentation& how, Index height, Index width, RandomStream& random) {
  const double scale = factor(random, how.zoom);
  const double turn = symmetric_uniform(random, how.turn_deg) * std::numbers::pi / 180;
  const double shift_x = symmetric_uniform(random, how.shift) * static_cast<double>(width);
  const double shift_y = symmetric_uniform(random, how.shift) * static_cast<double>(height);
  const double mirror = random.uniform() < how.flip ? -1 : 1;
  Placement place;
  place.right = {mirror * std::cos(turn) * scale, mirror * std::sin(turn) * scale};
  place.down = {-std::sin(turn) * scale, std::cos(turn) * scale};
  const double centre_x = static_cast<double>(width - 1) / 2, centre_y = static_cast<double>(height - 1) / 2;
  place.origin = {centre_x + shift_x - place.right[0] * centre_x - place.down[0] * centre_y,
                  centre_y + shift_y - place.right[1] * centre_x - place.down[1] * centre_y};
  return place;
}

/// out = gain · in + offset of each channel.
struct Tone {
  std::array<float, 3> gain, offset;
};

Tone random_tone(const Augmentation& how, RandomStream& random) {
  constexpr double kMidGrey = 127.5;
  const double brightness = factor(random, how.brightness), contrast = factor(random, how.contrast);
  Tone tone{};
  for (std::size_t c = 0; c < 3; ++c) {
    tone.gain[c] = static_cast<float>(contrast * brightness * factor(random, how.colour));
    tone.offset[c] = static_cast<float>(kMidGrey * (1 - contrast));
  }
  return tone;
}

}  // namespace

Image augmented(const Image& image, const Augmentation& how, RandomStream& random) {
  const Index height = image.height, width = image.width;
  const Placement place = random_placement(how, height, width, random);
  const Tone tone = random_tone(how, random);
  Image result{height, width, std::vector<std::uint8_t>(image.rgb.size())};
  const auto last_x = static_cast<float>(width - 1), last_y = static_cast<float>(height - 1);
  const auto noise = static_cast<float>(how.noise / 255);
  for (Index row = 0; row < height; ++row)
    for (Index column = 0; column < width; ++column) {
      const auto at = [&](std::size_t axis) {
        return static_cast<float>(place.origin[axis] + static_cast<double>(column) * place.right[axis] +
                                  static_cast<double>(row) * place.down[axis]);
      };
      const float x = std::clamp(at(0), 0.0f, last_x), y = std::clamp(at(1), 0.0f, last_y);
      const auto x0 = static_cast<Index>(x), y0 = static_cast<Index>(y);
      const Index x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
      const float dx = x - static_cast<float>(x0), dy = y - static_cast<float>(y0);
      const std::uint8_t* above = image.rgb.data() + 3 * y0 * width;
      const std::uint8_t* below = image.rgb.data() + 3 * y1 * width;
      std::uint8_t* to = result.rgb.data() + 3 * (row * width + column);
      const std::uint32_t bits[2] = {random.bits32(), random.bits32()};
      for (Index c = 0; c < 3; ++c) {
        const float upper =
            static_cast<float>(above[3 * x0 + c]) * (1 - dx) + static_cast<float>(above[3 * x1 + c]) * dx;
        const float lower =
            static_cast<float>(below[3 * x0 + c]) * (1 - dx) + static_cast<float>(below[3 * x1 + c]) * dx;
        // The sum of two uniform bytes has a triangular distribution, close to the noise of a sensor.
        const float grain = static_cast<float>((bits[0] >> (8 * c) & 255) + (bits[1] >> (8 * c) & 255)) - 255;
        const auto channel = static_cast<std::size_t>(c);
        const float level = (upper * (1 - dy) + lower * dy) * tone.gain[channel] + tone.offset[channel] + noise * grain;
        to[c] = static_cast<std::uint8_t>(std::clamp(level + 0.5f, 0.0f, 255.0f));
      }
    }
  return result;
}

}  // namespace svnet::train
