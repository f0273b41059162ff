#include "simulation/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace svnet::simulation {
namespace {

constexpr int kSrgbSteps = 1024;

/// A hash of lattice points to [0, 1).
float lattice(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
                    static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24f;
}

/// Value noise in [0, 1), one detail per unit.
float noise(const Vec3& p) {
  std::array<std::int32_t, 3> i{};
  Vec3 f;
  for (int k = 0; k < 3; ++k) {
    const float floored = std::floor(p[k]);
    i[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(floored);
    f[k] = p[k] - floored;
    f[k] = f[k] * f[k] * (3 - 2 * f[k]);
  }
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const auto row = [&](int y, int z) {
    return mix(lattice(i[0], i[1] + y, i[2] + z), lattice(i[0] + 1, i[1] + y, i[2] + z), f[0]);
  };
  return mix(mix(row(0, 0), row(1, 0), f[1]), mix(row(0, 1), row(1, 1), f[1]), f[2]);
}

Index texel(float t, Index size, Wrap wrap) {
  float part = 0;
  switch (wrap) {
    case Wrap::repeat:
      part = t - std::floor(t);
      break;
    case Wrap::mirror:
      part = 1 - std::abs(t - 2 * std::floor(t / 2) - 1);
      break;
    case Wrap::clamp:
      part = std::clamp(t, 0.0f, 1.0f);
      break;
  }
  return std::clamp(static_cast<Index>(part * static_cast<float>(size)), Index{0}, size - 1);
}

/// The image's nearest pixel, three levels.
const std::uint8_t* pixel_at(const Image& image, const Vec2& uv, const std::array<Wrap, 2>& wrap) {
  const Index y = texel(1 - uv.y(), image.height, wrap[1]), x = texel(uv.x(), image.width, wrap[0]);
  return &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
}

Vec3 image_colour(const Image& image, const Vec2& uv, const std::array<Wrap, 2>& wrap) {
  const std::uint8_t* rgb = pixel_at(image, uv, wrap);
  return {linear_from_srgb(rgb[0]), linear_from_srgb(rgb[1]), linear_from_srgb(rgb[2])};
}

}  // namespace

float linear_from_srgb(std::uint8_t level) {
  static const auto kTable = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float c = static_cast<float>(i) / 255;
      table[i] = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    }
    return table;
  }();
  return kTable[level];
}

std::span<const float> srgb_table() {
  // Over the root, where the curve is nearly straight; within 0.02 levels of it.
  static const auto kTable = [] {
    std::array<float, kSrgbSteps + 2> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const float root = static_cast<float>(i) / kSrgbSteps, c = root * root;
      table[i] = 255 * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f);
    }
    return table;
  }();
  return kTable;
}

float srgb_from_linear(float value) {
  const std::span<const float> table = srgb_table();
  const float place = std::sqrt(std::clamp(value, 0.0f, 1.0f)) * kSrgbSteps;
  const auto below = static_cast<std::size_t>(place);
  return table[below] + (place - static_cast<float>(below)) * (table[below + 1] - table[below]);
}

Vec3 surface_colour(const Material& material, const Vec3& local, const Vec2& uv, const std::vector<Image>& images) {
  float share = 0;
  const Vec3 p = local / material.scale_m;
  switch (material.texture) {
    case Texture::plain:
      return material.colour;
    case Texture::image:
      return material.colour.cwiseProduct(
          image_colour(images[static_cast<std::size_t>(material.image)], uv, material.wrap));
    case Texture::wood: {  // rings around an axis near x
      const float rings = p.y() + 0.7f * p.z() + 1.5f * noise(Vec3(0.12f * p.x(), 0.5f * p.y(), 0.5f * p.z()));
      share = 0.6f * (rings - std::floor(rings)) + 0.4f * noise(Vec3(0.6f * p.x(), 6 * p.y(), 6 * p.z()));
      break;
    }
    case Texture::brushed:
      share = noise(Vec3(0.1f * p.x(), 4 * p.y(), 4 * p.z()));
      break;
    case Texture::speckled:
      share = 0.6f * noise(p) + 0.4f * noise(2.7f * p);
      break;
    case Texture::stripes:
      share = p.x() - 2 * std::floor(p.x() / 2) < 1 ? 0.0f : 1.0f;
      break;
    case Texture::checks: {
      const float x = p.x() - std::floor(p.x()), y = p.y() - std::floor(p.y());
      share = std::min({x, y, 1 - x, 1 - y}) < 0.04f ? 1.0f : 0.25f * noise(6 * p);
      break;
    }
  }
  return material.colour + share * (material.second - material.colour);
}

bool is_metal(const Material& material, const Vec2& uv, const std::vector<Image>& images) {
  if (material.metal_image < 0) return material.metal;
  const Image& image = images[static_cast<std::size_t>(material.metal_image)];
  return material.metal_factor * static_cast<float>(pixel_at(image, uv, material.wrap)[2]) / 255 > 0.5f;
}

}  // namespace svnet::simulation
