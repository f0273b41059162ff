#include "view/render/setting.h"

#include <array>
#include <cmath>
#include <numbers>

namespace svnet {

Setting random_setting(RandomStream& random) {
  const auto between = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * random.uniform());
  };
  struct Table {
    Vec3 colour, second;
    Texture texture;
    float scale_m, gloss;
  };
  static const std::array<Table, 8> kTables{{
      {{0.62f, 0.61f, 0.58f}, {0.56f, 0.55f, 0.52f}, Texture::speckled, 0.004f, 0.02f},  // laminate
      {{0.42f, 0.27f, 0.15f}, {0.33f, 0.20f, 0.10f}, Texture::wood, 0.012f, 0.03f},      // oak
      {{0.66f, 0.52f, 0.36f}, {0.58f, 0.44f, 0.29f}, Texture::wood, 0.018f, 0.03f},      // birch
      {{0.80f, 0.80f, 0.79f}, {0.78f, 0.78f, 0.77f}, Texture::plain, 0.01f, 0.03f},      // white board
      {{0.10f, 0.17f, 0.28f}, {0.08f, 0.14f, 0.24f}, Texture::speckled, 0.002f, 0.0f},   // blue felt
      {{0.16f, 0.28f, 0.17f}, {0.13f, 0.24f, 0.14f}, Texture::speckled, 0.002f, 0.0f},   // cutting mat
      {{0.25f, 0.24f, 0.24f}, {0.20f, 0.19f, 0.19f}, Texture::speckled, 0.006f, 0.03f},  // stone
      {{0.55f, 0.47f, 0.42f}, {0.49f, 0.41f, 0.36f}, Texture::checks, 0.05f, 0.02f},     // tiles
  }};
  const Table& chosen = kTables[random.below(static_cast<std::uint32_t>(kTables.size()))];
  Setting setting;
  const float shade = between(0.85, 1.15);
  setting.table.colour = chosen.colour * shade;
  setting.table.second = chosen.second * shade;
  setting.table.texture = chosen.texture;
  setting.table.scale_m = chosen.scale_m * between(0.8, 1.3);
  setting.table.gloss = chosen.gloss;
  setting.table.sharpness = 30;

  // A main lamp, sometimes a second one, and the room. Together they light the table alike under all conditions.
  const float warmth = between(-0.12, 0.12), share = between(0.45, 0.75);
  const Vec3 tint(1 + warmth, 1, 1 - warmth);
  const std::uint32_t count = 1 + random.below(2);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float azimuth = between(0, 2 * std::numbers::pi), elevation = between(0.7, 1.35),
                distance = between(1.2, 2.2);
    const float part = share * (count == 1 ? 1.0f : (i == 0 ? 0.7f : 0.3f));
    setting.lamps.push_back({distance * Vec3(std::cos(elevation) * std::cos(azimuth),
                                             std::cos(elevation) * std::sin(azimuth), std::sin(elevation)),
                             between(0.1, 0.35), tint * part / std::sin(elevation)});
  }
  setting.sky = (Vec3::Ones() - 0.3f * (tint - Vec3::Ones())) * (1.05f - share);
  setting.wall = setting.sky * between(0.4, 0.8);
  return setting;
}

}  // namespace svnet
