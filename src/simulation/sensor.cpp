#include "simulation/sensor.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/random.h"
#include "simulation/render/sensor_kernels.h"
#include "simulation/texture.h"

namespace svnet::simulation {
namespace {

/// Blurs with a Gaussian of σ = 0.5 pixels, rows first. Border pixels are repeated.
std::vector<Vec3> blurred(const std::vector<Vec3>& from, Index height, Index width) {
  constexpr float kSide = 0.1065f, kMiddle = 1 - 2 * kSide;
  std::vector<Vec3> rows(from.size()), result(from.size());
  // A row as numbers, three for each pixel.
  const Index row = 3 * width;
  const auto mix = [&](const float* middle, const float* before, const float* after, Index count, float* out) {
    for (Index i = 0; i < count; ++i) out[i] = kMiddle * middle[i] + kSide * (before[i] + after[i]);
  };
  for (Index y = 0; y < height; ++y) {
    const float* in = from[static_cast<std::size_t>(y * width)].data();
    float* out = rows[static_cast<std::size_t>(y * width)].data();
    const Index second = std::min<Index>(3, row - 3), last = row - 3;
    mix(in, in, in + second, 3, out);
    if (width > 2) mix(in + 3, in, in + 6, row - 6, out + 3);
    if (width > 1) mix(in + last, in + last - 3, in + last, 3, out + last);
  }
  const auto row_at = [&](Index y) {
    return rows[static_cast<std::size_t>(std::clamp<Index>(y, 0, height - 1) * width)].data();
  };
  for (Index y = 0; y < height; ++y)
    mix(row_at(y), row_at(y - 1), row_at(y + 1), row, result[static_cast<std::size_t>(y * width)].data());
  return result;
}

/// 1 for pixels whose depth is more than 1 cm from that of the one at the left, at the right, above or below.
std::vector<std::uint8_t> silhouettes(const DepthImage& depth) {
  std::vector<std::uint8_t> result(depth.metres.size(), 0);
  const auto mark = [](const float* a, const float* b, Index count, std::uint8_t* out) {
    for (Index i = 0; i < count; ++i) out[i] |= static_cast<std::uint8_t>(std::abs(b[i] - a[i]) > 0.01f);
  };
  const auto mark_both = [&](Index a, Index b, Index count) {
    mark(&depth.metres[static_cast<std::size_t>(a)], &depth.metres[static_cast<std::size_t>(b)], count,
         &result[static_cast<std::size_t>(a)]);
    mark(&depth.metres[static_cast<std::size_t>(a)], &depth.metres[static_cast<std::size_t>(b)], count,
         &result[static_cast<std::size_t>(b)]);
  };
  for (Index y = 0; y < depth.height; ++y) {
    const Index row = y * depth.width;
    if (depth.width > 1) mark_both(row, row + 1, depth.width - 1);
    if (y + 1 < depth.height) mark_both(row, row + depth.width, depth.width);
  }
  return result;
}

void take_values(std::size_t count, const PolarDraw& draw, PolarValues& values) {
  for (std::size_t pair = 0; pair < 2; ++pair)
    for (std::size_t i = 0; i < count; ++i) {
      values.log[pair][i] = std::log(draw.uniform[pair][i]);
      const float angle = draw.angle[pair][i];
      values.sine[pair][i] = std::sin(angle), values.cosine[pair][i] = std::cos(angle);
    }
}

/// Room for a batch of pixels.
struct Sensing {
  Row<std::uint32_t> pixel, words[4];
  PolarDraw draw;
  PolarValues values;
  Rows3 light;
  Row<float> z, measured;
  Row<std::int32_t> levels[3];
};

}  // namespace

RgbdImage sensor_image(const Shot& shot, const ImageKey& key, float exposure) {
  constexpr float kHoleShare = 0.6f;
  const std::size_t pixels = shot.radiance.size();
  RgbdImage image{{shot.height, shot.width, std::vector<std::uint8_t>(pixels * 3)},
                  {shot.height, shot.width, std::vector<float>(pixels)}};
  if (pixels == 0) return image;
  const std::vector<Vec3> light = blurred(shot.radiance, shot.height, shot.width);
  const std::vector<std::uint8_t> on_silhouette = silhouettes(shot.depth);
  const auto room = std::make_unique<Sensing>();
  for (std::size_t first = 0; first < pixels; first += kRays) {
    const std::size_t count = std::min(kRays, pixels - first);
    for (std::size_t i = 0; i < count; ++i) {
      room->pixel[i] = static_cast<std::uint32_t>(first + i);
      room->light.set(i, light[first + i]);
      room->z[i] = shot.depth.metres[first + i];
    }
    random_words_of_each(key.seed, Stream::collection, key.number, room->pixel.at, count, 0,
                         {room->words[0].at, room->words[1].at, room->words[2].at, room->words[3].at});
    make_polar(count, room->words, room->draw);
    take_values(count, room->draw, room->values);
    develop(count, room->values, room->light, exposure, srgb_table(), room->levels);
    measure_depth(count, room->values, room->z, room->measured);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t pixel = first + i;
      for (std::size_t c = 0; c < 3; ++c) image.rgb.rgb[3 * pixel + c] = static_cast<std::uint8_t>(room->levels[c][i]);
      if (room->z[i] <= 0) continue;
      const auto is_hole = [&] {
        const std::uint64_t index = std::uint64_t{key.number} << 32 | pixel;
        return static_cast<float>(random_words(key.seed, Stream::collection, index, 1)[0] >> 8) * 0x1p-24f < kHoleShare;
      };
      if (on_silhouette[pixel] == 0 || !is_hole()) image.depth.metres[pixel] = room->measured[i];
    }
  }
  return image;
}

}  // namespace svnet::simulation
