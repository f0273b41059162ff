#include <cmath>
#include <numbers>

#include "simulation/catalogue/designs.h"
#include "simulation/catalogue/looks.h"

namespace svnet::simulation {
namespace {

using namespace looks;

/// blade length, handle length, ring radius, opening in degrees, blade width; metal, handles
void scissors(Sculptor& s, const Design& d) {
  const float blade = d[0], handle = d[1], ring = d[2], open = d[3], w = d[4];
  for (const float side : {-1.0f, 1.0f}) {
    const auto placed = [&](Part part) { part.move(0, 0, 1.1f).scale(1, side, side).turn_z(side * open); };
    s.use(d.look[0]);
    placed(s.plate({{-14, -w * 0.55f},
                    {0, -w * 0.55f},
                    {blade, -0.5f},
                    {blade, 0.5f},
                    {blade * 0.5f, w * 0.42f},
                    {0, w * 0.55f},
                    {-14, w * 0.35f}},
                   2.2f, 0.5f));
    s.use(d.look[1]);
    placed(s.tube(
        smooth(Path{{-6, 0, 0}, {-20, -4, 0}, {-handle * 0.5f, -ring * 0.4f, 0}, {-handle * 0.62f, -ring * 0.62f, 0}}),
        {4.5f}, false, 0.8f));
    Path loop;
    const float long_ring = side > 0 ? 1.5f : 1.15f;
    for (const Vec2& p : circle(ring, 28)) loop.emplace_back(p.x() * long_ring, p.y(), 0);
    placed(
        s.tube(loop, {4}, true, 0.9f, 12).turn_z(15).move(-handle * 0.62f - ring * long_ring * 0.85f, -ring * 1.1f, 0));
  }
  s.use(d.look[0]);
  s.cylinder(4, 6.5f, 0.8f);
}

/// length, width, height, opening in degrees, nose roundness; body, metal, base
void stapler(Sculptor& s, const Design& d) {
  const float length = d[0], w = d[1], h = d[2], open = d[3];
  s.use(d.look[2]);
  s.strip({{-length * 0.5f, w * 0.45f, 6},
           {-length * 0.42f, w * 0.5f, 8},
           {0, w * 0.46f, 7},
           {length * 0.42f, w * 0.52f, 7},
           {length * 0.5f, w * 0.4f, 5}},
          6, 4)
      .move(0, 0, 4);
  s.use(d.look[1]);
  s.box(13, w * 0.6f, 1.5f, 0.4f).move(length * 0.42f, 0, 8);
  const auto hinged = [&](Part part) {
    part.move(length * 0.42f, 0, 0).turn_y(-open).move(-length * 0.42f, 0, h * 0.5f);
  };
  hinged(s.box(length * 0.88f, w * 0.5f, h * 0.3f, 0.8f).move(length * 0.03f, 0, h * 0.02f));
  s.use(d.look[0]);
  hinged(s.strip({{-length * 0.47f, w * 0.36f, h * 0.35f, h * 0.2f},
                  {-length * 0.4f, w * 0.5f, h * 0.62f, h * 0.28f},
                  {0, w * 0.48f, h * 0.55f, h * 0.33f},
                  {length * 0.35f, w * 0.46f, h * 0.48f, h * 0.3f},
                  {length * 0.5f, w * 0.34f, h * 0.3f, h * 0.2f}},
                 6, d[4]));
  s.use(d.look[1]);
  s.cylinder(3.5f, w * 1.08f).turn_x(90).move(-length * 0.4f, 0, h * 0.5f);
  s.use(d.look[2]);
  for (const float side : {-1.0f, 1.0f})
    s.box(length * 0.16f, 2.5f, h * 0.6f, 1).move(-length * 0.4f, side * w * 0.5f, h * 0.36f);
}

/// base radius, lower arm, upper arm, shade radius, shade length, kind (0 jointed, 1 bent neck, 2 table lamp); body,
/// shade, bulb
void lamp(Sculptor& s, const Design& d) {
  const float base = d[0], lower = d[1], upper = d[2], r = d[3], shade = d[4];
  const int kind = d.kind(5);
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{base * 0.92f, 0}, {base, 3}, {base * 0.95f, 12}, {base * 0.5f, 18}, {8, 22}}, 4), 48);
  const auto cone = [&](float top, const auto& place) {
    s.use(d.look[1]);
    place(s.lathe({{top, 0}, {top + 2, 0}, {r, -shade}, {r - 2, -shade - 0.5f}, {top - 1, -2}, {0, -2}}, 48));
    s.use(d.look[2]);
    place(s.ball(r * 0.38f, r * 0.38f, r * 0.45f).move(0, 0, -shade * 0.62f));
  };
  if (kind == 2) {
    s.lathe(smooth(Outline{{9, 18}, {26, 40}, {30, lower * 0.4f}, {18, lower * 0.75f}, {8, lower}, {6, lower + 12}}, 5),
            40);
    cone(r * 0.6f, [&](Part part) { part.move(0, 0, lower + shade + 4); });
    return;
  }
  const auto tilted = [&](const Vec3& at, float angle) {
    return [=](Part part) { part.turn_y(angle).move(at.x(), at.y(), at.z()); };
  };
  if (kind == 1) {
    const Path neck = smooth(Path{{0, 0, 15},
                                  {-lower * 0.12f, 0, lower * 0.5f},
                                  {0, 0, lower},
                                  {upper * 0.4f, 0, lower + upper * 0.25f},
                                  {upper * 0.85f, 0, lower + upper * 0.12f}});
    s.tube(neck, {6});
    cone(14, tilted(neck.back() + Vec3(2, 0, 2), -35));
    return;
  }
  const Vec3 elbow(-lower * 0.45f, 0, 15 + lower * 0.88f), end(elbow + Vec3(upper * 0.9f, 0, upper * 0.4f));
  for (const float y : {-7.0f, 7.0f}) {
    s.tube({{0, y, 15}, elbow + Vec3(0, y, 0)}, {3});
    s.tube({elbow + Vec3(0, y, 0), end + Vec3(0, y, 0)}, {3});
  }
  s.cylinder(9, 24, 1).turn_x(90).move(elbow.x(), 0, elbow.z());
  s.cylinder(9, 24, 1).turn_x(90).move(end.x(), 0, end.z());
  s.cylinder(9, 24, 1).turn_x(90).move(0, 0, 18);
  cone(16, tilted(end + Vec3(6, 0, 0), -25));
}

/// radius, width, thickness of the roll, core thickness, loose end; tape, core
void tape(Sculptor& s, const Design& d) {
  const float r = d[0], w = d[1], t = d[2], core = d[3], loose = d[4];
  s.use(d.look[0]);
  const auto ring = [&](float outer, float inner, float width) {
    s.plate(circle(outer, 64), width, 0.6f, {circle(inner, 64)});
  };
  ring(r, r - t, w);
  std::vector<Path> rings;  // the end that hangs off
  for (int i = 0; i <= 16; ++i) {
    const float u = static_cast<float>(i) / 16;
    const Vec3 at(-loose * u + 2 * std::sin(5 * u), r - 0.3f - loose * 0.2f * u * u, 0);
    rings.push_back({at + Vec3(0, -0.4f, -w / 2), at + Vec3(0, -0.4f, w / 2), at + Vec3(0, 0.4f, w / 2),
                     at + Vec3(0, 0.4f, -w / 2)});
  }
  s.loft(rings);
  s.use(d.look[1]);
  ring(r - t + 0.3f, r - t - core, w * 0.99f);
}

/// body length, body radius, prong length, prongs, cable length, kind (0 round prongs, 1 flat prongs); body, metal,
/// cable
void plug(Sculptor& s, const Design& d) {
  const float length = d[0], r = d[1], prong = d[2], cable = d[4];
  const int prongs = d.kind(3);
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{r * 0.95f, 0},
                         {r, 2},
                         {r, length * 0.25f},
                         {r * 0.82f, length * 0.45f},
                         {r * 0.72f, length * 0.7f},
                         {r * 0.4f, length * 0.95f},
                         {r * 0.25f, length * 1.25f}},
                 4),
          40)
      .scale(1, d.kind(5) == 0 ? 1.0f : 0.75f, 1);
  for (int i = 0; i < 5; ++i) s.torus(r * 0.32f, 1.4f).move(0, 0, length * (0.98f + 0.06f * static_cast<float>(i)));
  s.use(d.look[1]);
  for (int i = 0; i < prongs; ++i) {
    const float x = (i == 2 ? 0 : (i == 0 ? -1.0f : 1.0f)) * r * 0.5f,
                y = i == 2 ? r * 0.45f : (prongs == 3 ? -r * 0.2f : 0.0f);
    if (d.kind(5) == 0)
      s.lathe({{1.2f, -prong}, {2.4f, -prong + 2}, {2.4f, 2}}, 20).move(x, y, 0);
    else
      i == 2 ? s.cylinder(2.4f, prong + 2, 1).move(x, y, -prong / 2)
             : s.box(1.8f, 6.5f, prong + 2, 0.4f).move(x, y, -prong / 2);
  }
  s.use(d.look[2]);
  s.tube(smooth(Path{{0, 0, length},
                     {0, 0, length * 1.4f},
                     {cable * 0.12f, 0, length + cable * 0.35f},
                     {cable * 0.5f, 0, length + cable * 0.42f},
                     {cable * 0.62f, 0, length + cable * 0.1f},
                     {cable * 0.45f, 0, length * 0.6f}},
                8),
         {r * 0.2f});
}

}  // namespace

std::vector<CategoryDesigns> household_designs() {
  return {
      {"scissors",
       scissors,
       {{{95, 95, 15, 9, 15}, {steel(), black()}},
        {{75, 80, 14, 14, 13}, {chrome(), red()}},
        {{110, 105, 16, 6, 17}, {steel(), orange()}},
        {{60, 75, 13, 18, 12}, {chrome(), chrome()}},
        {{85, 90, 16, 12, 16}, {iron(), blue()}}}},
      {"stapler",
       stapler,
       {{{140, 34, 45, 8, 3}, {black(), chrome(), black()}},
        {{120, 30, 40, 10, 2.4f}, {red(), steel(), grey()}},
        {{160, 38, 52, 7, 4}, {metal(0.45f, 0.46f, 0.48f, 40), chrome(), black()}},
        {{100, 28, 36, 12, 2.2f}, {blue(), chrome(), white()}},
        {{135, 32, 48, 14, 5}, {teal(), steel(), black()}}}},
      {"lamp",
       lamp,
       {{{70, 150, 140, 60, 80, 0}, {black(), black(), plastic(0.9f, 0.88f, 0.8f)}},
        {{65, 180, 110, 50, 65, 1}, {chrome(), red(), plastic(0.9f, 0.88f, 0.8f)}},
        {{60, 150, 0, 85, 90, 2}, {ceramic(0.1f, 0.25f, 0.4f), matte(0.8f, 0.75f, 0.6f), plastic(0.9f, 0.88f, 0.8f)}},
        {{75, 170, 130, 55, 70, 0}, {steel(), white(), plastic(0.9f, 0.88f, 0.8f)}},
        {{62, 160, 120, 58, 60, 1}, {brass(), green(), plastic(0.9f, 0.88f, 0.8f)}}}},
      {"tape",
       tape,
       {{{45, 24, 14, 2.5f, 25}, {clear(0.75f, 0.65f, 0.4f, 0.2f), matte(0.5f, 0.38f, 0.24f)}},
        {{55, 48, 10, 4, 35}, {plastic(0.42f, 0.25f, 0.1f), matte(0.5f, 0.38f, 0.24f)}},
        {{40, 19, 20, 2, 20}, {black(), white()}},
        {{60, 50, 22, 3.5f, 40}, {plastic(0.45f, 0.46f, 0.48f), matte(0.5f, 0.38f, 0.24f)}},
        {{38, 15, 16, 2, 30}, {yellow(), blue()}}}},
      {"plug",
       plug,
       {{{34, 18, 19, 2, 100, 0}, {white(), chrome(), white()}},
        {{38, 20, 19, 2, 120, 0}, {black(), brass(), black()}},
        {{32, 19, 17, 3, 110, 1}, {black(), brass(), black()}},
        {{30, 17, 17, 2, 90, 1}, {white(), brass(), white()}},
        {{40, 22, 20, 3, 105, 0}, {orange(), chrome(), orange()}}}},
  };
}

}  // namespace svnet::simulation
