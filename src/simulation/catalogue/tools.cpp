#include <cmath>
#include <numbers>

#include "simulation/catalogue/designs.h"
#include "simulation/catalogue/looks.h"

namespace svnet::simulation {
namespace {

using namespace looks;
constexpr float kDegree = std::numbers::pi_v<float> / 180;

/// handle length, handle radius, head length, head radius, kind (0 claw, 1 ball peen, 2 mallet, 3 sledge); handle, head
void hammer(Sculptor& s, const Design& d) {
  const float length = d[0], r = d[1], head = d[2], radius = d[3];
  s.use(d.look[0]);
  s.strip({{-length, r * 0.9f, r * 2.2f},
           {-length * 0.93f, r * 1.25f, r * 2.9f},
           {-length * 0.6f, r * 1.1f, r * 2.5f},
           {-length * 0.3f, r * 0.75f, r * 1.9f},
           {0, r * 0.8f, r * 2},
           {radius * 1.1f, r * 0.8f, r * 2}},
          6, 2.5f);
  s.use(d.look[1]);
  const int kind = d.kind(4);
  if (kind == 2) {
    s.cylinder(radius, head, 3).turn_x(90);
    return;
  }
  s.plate(rounded_rectangle(radius * 2, radius * 2.2f, 4), radius * 1.9f, 2);  // around the handle's end
  const auto face = [&](float sign) {
    s.lathe({{radius * 0.75f, 0},
             {radius * 0.7f, head * 0.25f},
             {radius, head * 0.32f},
             {radius, head * 0.5f - 2},
             {radius - 2, head * 0.5f}})
        .turn_x(sign > 0 ? -90 : 90);
  };
  face(1);
  if (kind == 3) face(-1);
  if (kind == 1) {
    s.lathe({{radius * 0.7f, 0}, {radius * 0.55f, head * 0.3f}}).turn_x(90);
    s.ball(radius * 0.85f, radius * 0.85f, radius * 0.85f).move(0, -head * 0.4f, 0);
  }
  if (kind == 0)
    for (const float side : {-1.0f, 1.0f})
      s.strip({{0, radius * 0.42f, radius * 1.1f},
               {head * 0.3f, radius * 0.42f, radius * 0.8f},
               {head * 0.6f, radius * 0.3f, radius * 0.3f}},
              6, 3)
          .move(0, side * radius * 0.44f, 0)
          .bend([&](Vec3 p) {
            return Vec3(p.x(), p.y() * (0.75f + p.x() / head * 0.8f), p.z() - p.x() * p.x() / head * 0.75f);
          })
          .turn_x(-90)
          .turn_z(-90);
}

/// length, head radius, opening, thickness, kind (0 combination, 1 double open, 2 double ring, 3 adjustable); metal,
/// grip
void wrench(Sculptor& s, const Design& d) {
  const float length = d[0], radius = d[1], opening = d[2], t = d[3];
  const int kind = d.kind(4);
  s.use(d.look[0]);
  const auto jaw = [&](float x, float turn, float size) {
    Outline c;
    const float outer = radius * size, half = opening * size / 2;
    for (int a = 32; a <= 328; a += 8)
      c.emplace_back(outer * std::cos(a * kDegree), outer * std::sin(a * kDegree) * 1.02f);
    c.emplace_back(outer * 0.95f, -half);
    c.emplace_back(-outer * 0.05f, -half);
    c.emplace_back(-outer * 0.35f, -half * 0.4f);
    c.emplace_back(-outer * 0.35f, half * 0.4f);
    c.emplace_back(-outer * 0.05f, half);
    c.emplace_back(outer * 0.95f, half);
    s.plate(c, t * 1.25f, 0.8f).turn_z(turn).move(x, 0, 0);
  };
  const auto ring = [&](float x, float size) {
    s.plate(circle(radius * 0.82f * size, 40), t * 1.5f, 1, {circle(opening * 0.52f * size, 12)}).move(x, 0, 0);
  };
  s.plate(rounded_rectangle(length - radius, radius * 0.72f, 3), t, 1.2f);
  s.plate(rounded_rectangle(length - radius * 2.2f, radius * 0.32f, 2), t * 1.15f, 0.5f);
  const float end = length / 2;
  if (kind == 2) {
    ring(end, 1), ring(-end, 0.8f);
  } else if (kind == 3) {
    s.plate({{0, -radius},
             {radius * 1.1f, -radius * 1.0f},
             {radius * 1.5f, -radius * 0.75f},
             {radius * 1.9f, -radius * 0.8f},
             {radius * 1.9f, -radius * 0.45f},
             {radius * 0.75f, -radius * 0.42f},
             {radius * 0.7f, radius * 0.55f},
             {0, radius * 0.8f},
             {-radius * 0.8f, 0}},
            t * 1.4f, 1)
        .turn_z(12)
        .move(end - radius, 0, 0);
    s.plate({{radius * 0.75f, radius * 0.3f},
             {radius * 1.9f, radius * 0.32f},
             {radius * 1.9f, radius * 0.6f},
             {radius * 1.2f, radius * 0.85f},
             {radius * 0.7f, radius * 0.8f}},
            t * 1.2f, 0.8f)
        .turn_z(12)
        .move(end - radius, 0, 0);
    s.cylinder(radius * 0.27f, radius * 0.7f).turn_y(90).turn_z(12).move(end - radius * 0.75f, radius * 0.1f, 0);
    s.use(d.look[1]);
    s.plate(rounded_rectangle(length * 0.55f, radius * 0.85f, 6), t * 1.6f, 2).move(-length * 0.2f, 0, 0);
  } else {
    jaw(end, 15, 1);
    kind == 0 ? ring(-end, 0.85f) : jaw(-end, 195, 0.85f);
  }
}

/// handle length, handle radius, shaft length, shaft radius, kind (0 flat, 1 cross), flutes; handle, metal, accent
void screwdriver(Sculptor& s, const Design& d) {
  const float handle = d[0], r = d[1], shaft = d[2], thin = d[3];
  const float flutes = std::round(d[5]);
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{r * 0.2f, 0},
                         {r * 0.8f, 2},
                         {r, handle * 0.15f},
                         {r * 0.95f, handle * 0.5f},
                         {r, handle * 0.68f},
                         {r * 0.62f, handle * 0.82f},
                         {r * 0.72f, handle * 0.95f},
                         {r * 0.6f, handle}}),
          64)
      .bend([&](Vec3 p) {
        const float along = p.z() / handle,
                    depth = along > 0.1f && along < 0.72f ? 0.1f * std::sin((along - 0.1f) / 0.62f * 180 * kDegree) : 0;
        const float groove = 1 - depth * (1 + std::cos(flutes * std::atan2(p.y(), p.x())));
        return Vec3(p.x() * groove, p.y() * groove, p.z());
      })
      .turn_y(90);
  s.use(d.look[2]);
  s.lathe({{r * 0.6f, 0}, {r * 0.62f, 1}, {r * 0.4f, 4}}).turn_y(-90).move(0.5f, 0, 0);
  s.cylinder(r * 0.66f, handle * 0.05f).turn_y(90).move(handle * 0.97f, 0, 0);
  s.use(d.look[1]);
  s.cylinder(thin, shaft).turn_y(90).move(handle + shaft / 2, 0, 0);
  if (d.kind(4) == 0)
    s.loft({{{0, -thin, -thin}, {0, thin, -thin}, {0, thin, thin}, {0, -thin, thin}},
            {{7, -thin * 1.5f, -thin * 0.6f},
             {7, thin * 1.5f, -thin * 0.6f},
             {7, thin * 1.5f, thin * 0.6f},
             {7, -thin * 1.5f, thin * 0.6f}},
            {{14, -thin * 1.3f, -0.4f}, {14, thin * 1.3f, -0.4f}, {14, thin * 1.3f, 0.4f}, {14, -thin * 1.3f, 0.4f}}})
        .move(handle + shaft - 3, 0, 0);
  else
    s.lathe({{thin, 0}, {thin, 1}, {thin * 0.3f, 8}}).turn_y(90).move(handle + shaft, 0, 0);
}

/// length, grip radius, opening in degrees, jaw length, kind (0 combination, 1 long nose, 2 cutter); metal, grip
void pliers(Sculptor& s, const Design& d) {
  const float length = d[0], r = d[1], open = d[2], jaw = d[3];
  const int kind = d.kind(4);
  for (const float side : {-1.0f, 1.0f}) {
    const auto placed = [&](Part part) { part.scale(1, side, 1).turn_z(side * open); };
    s.use(d.look[0]);
    const float tip = kind == 1 ? 2.5f : (kind == 2 ? 5.0f : 9.0f);
    placed(s.plate(smooth(Outline{{-9, -2},
                                  {0, 0.2f},
                                  {jaw * 0.5f, 0.3f},
                                  {jaw, 0.3f},
                                  {jaw, tip * 0.6f},
                                  {jaw * 0.55f, tip + 3},
                                  {6, 13},
                                  {-6, 12}},
                          4, true),
                   9, 1));
    const Path handle = smooth(
        Path{{0, 4 * -1, 0}, {-14, -9, 0}, {-length * 0.35f, -21, 0}, {-length * 0.7f, -24, 0}, {-length, -17, 0}}, 6);
    placed(s.tube(handle, {r * 0.7f}, false, 0.8f));
    s.use(d.look[1]);
    placed(s.tube(Path(handle.begin() + 9, handle.end()),
                  {r * 0.9f, r, r * 1.05f, r * 1.1f, r * 1.1f, r * 1.15f, r * 1.15f, r * 1.15f, r * 1.1f, r * 1.1f,
                   r * 1.1f, r * 1.1f, r * 1.1f, r, r * 0.8f, r * 0.6f},
                  false, 0.85f));
  }
  s.use(d.look[0]);
  s.cylinder(11, 11, 1);
  s.cylinder(5, 13, 1);
}

/// frame height, depth, bar width, screw radius, kind (0 G-clamp, 1 bar clamp); frame, metal, handle
void clamp(Sculptor& s, const Design& d) {
  const float h = d[0], depth = d[1], w = d[2], r = d[3];
  s.use(d.look[0]);
  if (d.kind(4) == 0) {
    s.plate({{0, 0},
             {depth + w, 0},
             {depth + w, w * 0.9f},
             {w * 1.5f, w},
             {w, w * 1.5f},
             {w, h - w * 1.5f},
             {w * 1.5f, h - w},
             {depth + w, h - w},
             {depth + w, h},
             {w * 0.6f, h},
             {0, h - w * 0.6f}},
            w * 0.8f, 1.5f);
    s.cylinder(w * 0.75f, w * 1.2f).turn_x(90).move(depth + w * 0.4f, w * 0.5f, 0);
  } else {
    s.use(d.look[1]);
    s.box(w * 0.7f, h * 1.5f, w * 0.4f).move(0, h * 0.6f, 0);
    s.use(d.look[0]);
    s.plate(
        {{-w * 0.8f, h - w}, {depth + w, h - w * 0.7f}, {depth + w, h}, {0, h + w * 0.7f}, {-w * 0.8f, h + w * 0.6f}},
        w * 0.9f, 1.5f);
    s.plate({{-w * 0.8f, -w * 0.6f}, {depth + w, 0}, {depth + w, w * 0.8f}, {w, w * 1.1f}, {-w * 0.8f, w * 1.5f}},
            w * 0.9f, 1.5f);
  }
  const float x = depth + w * 0.4f;
  s.use(d.look[1]);
  const float screw = h * 0.85f;
  s.lathe(
       [&] {
         Outline thread;
         for (int i = 0; i <= 44; ++i)
           thread.emplace_back(i % 2 == 0 ? r : r * 0.84f, screw * static_cast<float>(i) / 44);
         return thread;
       }(),
       20)
      .turn_x(-90)
      .move(x, -h * 0.42f, 0);
  s.cylinder(r * 1.9f, 5).turn_x(90).move(x, h * 0.44f, 0);
  s.use(d.look[2]);
  if (d.kind(4) == 0)
    s.cylinder(r * 0.5f, w * 3.4f).turn_y(90).move(x, -h * 0.4f, 0),
        s.ball(r * 0.8f, r * 0.8f, r * 0.8f).move(x + w * 1.7f, -h * 0.4f, 0),
        s.ball(r * 0.8f, r * 0.8f, r * 0.8f).move(x - w * 1.7f, -h * 0.4f, 0);
  else
    s.lathe(smooth(Outline{{r * 1.2f, 0}, {r * 2.2f, 8}, {r * 1.9f, h * 0.2f}, {r * 2.3f, h * 0.42f}, {r, h * 0.46f}}),
            24)
        .turn_x(90)
        .move(x, -h * 0.3f, 0);
}

/// handle length, width, bristle length, bristle thickness, ferrule length; handle, ferrule, bristles
void brush(Sculptor& s, const Design& d) {
  const float handle = d[0], w = d[1], bristle = d[2], t = d[3], ferrule = d[4];
  s.use(d.look[0]);
  s.strip({{-handle - ferrule, 5, 5},
           {-handle * 0.85f - ferrule, 10, 9},
           {-handle * 0.55f - ferrule, 8, 9},
           {-handle * 0.3f - ferrule, 7, 9},
           {-ferrule - 6, w * 0.44f, t * 0.95f},
           {-ferrule * 0.5f, w * 0.46f, t}},
          6, 2.6f);
  s.use(d.look[1]);
  s.plate(rounded_rectangle(ferrule, w, 1.5f), t * 1.1f, 1).move(-ferrule / 2, 0, 0);
  for (const float x : {0.2f, 0.8f}) s.box(1.2f, w * 1.02f, t * 1.18f, 0.4f).move(-ferrule * x, 0, 0);
  s.use(d.look[2]);
  const int across = std::max(5, static_cast<int>(w / 1.6f)), deep = std::max(3, static_cast<int>(t / 2.2f));
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < deep; ++k) {
      const float u = 2 * static_cast<float>(i) / static_cast<float>(across - 1) - 1,
                  v = 2 * static_cast<float>(k) / static_cast<float>(deep - 1) - 1;
      const float reach =
          bristle * (1 - 0.12f * u * u - 0.18f * v * v - 0.05f * static_cast<float>((i * 7 + k * 5) % 4));
      s.tube({{-2, u * w * 0.47f, v * t * 0.44f},
              {reach * 0.6f, u * w * 0.5f, v * t * 0.46f},
              {reach, u * w * 0.49f, v * t * 0.16f}},
             {0.95f, 0.95f, 0.35f}, false, 1, 5);
    }
}

}  // namespace

std::vector<CategoryDesigns> tool_designs() {
  return {
      {"hammer",
       hammer,
       {{{250, 11, 110, 14, 0}, {beech(), steel()}},
        {{230, 12, 120, 15, 0}, {blue(), chrome()}},
        {{280, 10, 95, 14, 1}, {wood(0.7f, 0.5f, 0.28f), iron()}},
        {{240, 13, 105, 32, 2}, {beech(), black()}},
        {{260, 12, 100, 20, 3}, {orange(), iron()}}}},
      {"wrench",
       wrench,
       {{{170, 17, 15, 6, 0}, {chrome(), black()}},
        {{220, 20, 18, 7, 1}, {steel(), black()}},
        {{190, 16, 14, 6, 2}, {chrome(), black()}},
        {{200, 19, 17, 9, 3}, {steel(), red()}},
        {{140, 14, 12, 5, 0}, {iron(), black()}}}},
      {"screwdriver",
       screwdriver,
       {{{100, 16, 110, 3.2f, 0, 6}, {red(), chrome(), black()}},
        {{90, 14, 90, 2.6f, 1, 8}, {yellow(), steel(), black()}},
        {{110, 18, 150, 4, 0, 6}, {blue(), steel(), white()}},
        {{80, 17, 60, 3.5f, 1, 5}, {wood(0.6f, 0.3f, 0.12f), iron(), brass()}},
        {{95, 12, 130, 2.2f, 0, 6}, {clear(0.8f, 0.5f, 0.05f, 0.35f), chrome(), orange()}}}},
      {"pliers",
       pliers,
       {{{120, 7, 8, 45, 0}, {steel(), red()}},
        {{110, 6, 10, 70, 1}, {chrome(), blue()}},
        {{115, 7, 6, 30, 2}, {iron(), orange()}},
        {{135, 8, 14, 50, 0}, {iron(), yellow()}},
        {{100, 6.5f, 5, 60, 1}, {steel(), green()}}}},
      {"clamp",
       clamp,
       {{{100, 60, 14, 5, 0}, {iron(), steel(), steel()}},
        {{80, 45, 13, 5, 0}, {red(), chrome(), chrome()}},
        {{120, 75, 20, 5, 1}, {orange(), steel(), beech()}},
        {{140, 70, 17, 6, 0}, {blue(), steel(), steel()}},
        {{100, 65, 18, 4.5f, 1}, {black(), chrome(), red()}}}},
      {"brush",
       brush,
       {{{110, 50, 50, 14, 35}, {beech(), steel(), matte(0.06f, 0.05f, 0.04f)}},
        {{120, 25, 38, 9, 25}, {red(), chrome(), matte(0.7f, 0.6f, 0.42f)}},
        {{100, 75, 55, 16, 38}, {blue(), steel(), matte(0.35f, 0.2f, 0.1f)}},
        {{130, 38, 45, 12, 30}, {walnut(), brass(), matte(0.8f, 0.78f, 0.7f)}},
        {{105, 60, 60, 20, 40}, {yellow(), iron(), matte(0.12f, 0.1f, 0.1f)}}}},
  };
}

}  // namespace svnet::simulation
