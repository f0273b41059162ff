#include "simulation/setting.h"

#include <array>
#include <cmath>
#include <numbers>

namespace svnet::simulation {

Setting random_setting(RandomStream& random) {
  const auto between = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * random.uniform());
  };
  struct Table {
    Vec3 colour, second;
    Texture texture;
    float scale_m, gloss;
  };
  // Tables without strong patterns, as in a laboratory: a pattern would dominate the features of an object.
  static const std::array<Table, 4> kTables{{
      {{0.62f, 0.61f, 0.58f}, {0.57f, 0.56f, 0.53f}, Texture::speckled, 0.004f, 0.02f},  // laminate
      {{0.66f, 0.56f, 0.43f}, {0.62f, 0.52f, 0.39f}, Texture::wood, 0.018f, 0.03f},      // birch
      {{0.80f, 0.80f, 0.79f}, {0.78f, 0.78f, 0.77f}, Texture::plain, 0.01f, 0.03f},      // white board
      {{0.40f, 0.40f, 0.40f}, {0.37f, 0.37f, 0.37f}, Texture::speckled, 0.006f, 0.03f},  // stone
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

  // A main lamp, sometimes a second one, and the room. The sum of their light on the table is always about the same.
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

}  // namespace svnet::simulation
