#include "simulation/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "simulation/texture.h"

namespace svnet::simulation {
namespace {

/// Blurs with a Gaussian of σ = 0.5 pixels, rows first. Border pixels are repeated.
std::vector<Vec3> blurred(const std::vector<Vec3>& from, Index height, Index width) {
  constexpr float kSide = 0.1065f, kMiddle = 1 - 2 * kSide;
  std::vector<Vec3> rows(from.size()), result(from.size());
  const auto at = [&](Index y, Index x) { return static_cast<std::size_t>(y * width + x); };
  for (Index y = 0; y < height; ++y)
    for (Index x = 0; x < width; ++x)
      rows[at(y, x)] = kMiddle * from[at(y, x)] +
                       kSide * (from[at(y, std::max<Index>(x - 1, 0))] + from[at(y, std::min(x + 1, width - 1))]);
  for (Index y = 0; y < height; ++y)
    for (Index x = 0; x < width; ++x)
      result[at(y, x)] = kMiddle * rows[at(y, x)] +
                         kSide * (rows[at(std::max<Index>(y - 1, 0), x)] + rows[at(std::min(y + 1, height - 1), x)]);
  return result;
}

/// Four standard normal numbers (Box and Muller 1958).
std::array<float, 4> normals(const std::array<std::uint32_t, 4>& words) {
  std::array<float, 4> result{};
  for (std::size_t pair = 0; pair < 4; pair += 2) {
    const float u = (static_cast<float>(words[pair] >> 8) + 1) * 0x1p-24f;
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(words[pair + 1] >> 8) * 0x1p-24f;
    const float radius = std::sqrt(-2 * std::log(u));
    result[pair] = radius * std::cos(angle);
    result[pair + 1] = radius * std::sin(angle);
  }
  return result;
}

/// Whether the depth jumps by more than 1 cm between a pixel and the one at the left, at the right, above or below.
bool on_silhouette(const DepthImage& depth, Index y, Index x) {
  const float here = depth.metres[static_cast<std::size_t>(y * depth.width + x)];
  for (const auto& [dy, dx] : {std::pair(0, 1), std::pair(0, -1), std::pair(1, 0), std::pair(-1, 0)}) {
    const Index ny = y + dy, nx = x + dx;
    if (ny < 0 || nx < 0 || ny >= depth.height || nx >= depth.width) continue;
    if (std::abs(depth.metres[static_cast<std::size_t>(ny * depth.width + nx)] - here) > 0.01f) return true;
  }
  return false;
}

}  // namespace

RgbdImage sensor_image(const Shot& shot, const ImageKey& key, float exposure) {
  constexpr float kDepthNoise = 0.0014f, kHoleShare = 0.6f;
  constexpr float kShotNoise = 0.0003f, kReadNoise = 0.0016f;  // variance per light, and σ in the dark
  RgbdImage image{{shot.height, shot.width, std::vector<std::uint8_t>(shot.radiance.size() * 3)},
                  {shot.height, shot.width, std::vector<float>(shot.radiance.size())}};
  const std::vector<Vec3> light = blurred(shot.radiance, shot.height, shot.width);
  for (Index y = 0; y < shot.height; ++y)
    for (Index x = 0; x < shot.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * shot.width + x);
      const std::uint64_t index = std::uint64_t{key.number} << 32 | pixel;
      const auto n = normals(random_words(key.seed, Stream::collection, index, 0));
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = exposure * light[pixel][static_cast<Index>(c)];
        const float sigma = std::sqrt(kShotNoise * std::max(value, 0.0f) + kReadNoise * kReadNoise);
        image.rgb.rgb[3 * pixel + c] = static_cast<std::uint8_t>(std::lround(srgb_from_linear(value + sigma * n[c])));
      }
      const float z = shot.depth.metres[pixel];
      if (z <= 0) continue;
      if (on_silhouette(shot.depth, y, x) &&
          static_cast<float>(random_words(key.seed, Stream::collection, index, 1)[0] >> 8) * 0x1p-24f < kHoleShare)
        continue;
      image.depth.metres[pixel] = std::max(0.0f, std::round(1000 * (z + kDepthNoise * z * z * n[3])) / 1000);
    }
  return image;
}

}  // namespace svnet::simulation
