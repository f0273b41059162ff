#include <cmath>
#include <numbers>

#include "simulation/catalogue/designs.h"
#include "simulation/catalogue/looks.h"

namespace svnet::simulation {
namespace {

using namespace looks;

/// length, height, back height, teeth, thickness, handle length; body
void comb(Sculptor& s, const Design& d) {
  const float length = d[0], h = d[1], back = d[2], t = d[4], handle = d[5];
  const int teeth = d.kind(3);
  s.use(d.look[0]);
  s.plate(rounded_rectangle(length + 2, back, std::min(3.0f, back * 0.45f)), t, 0.8f).move(0, h / 2 - back / 2, 0);
  const float pitch = (length - 8) / static_cast<float>(teeth);
  for (int i = 0; i < teeth; ++i) {
    const float x = -length / 2 + 4 + pitch * (static_cast<float>(i) + 0.5f), w = pitch * 0.52f,
                root = h / 2 - back + 1, tip = -h / 2;
    s.plate({{-w / 2, root}, {-w * 0.22f, tip + 1.5f}, {0, tip}, {w * 0.22f, tip + 1.5f}, {w / 2, root}}, t * 0.75f,
            0.15f)
        .move(x, 0, 0);
  }
  for (const float side : {-1.0f, 1.0f})
    s.plate({{-2.5f, h / 2 - back + 1}, {-1.5f, -h / 2}, {1.5f, -h / 2}, {2.5f, h / 2 - back + 1}}, t, 0.5f)
        .move(side * (length / 2 - 2), 0, 0);
  if (handle > 5)
    s.strip({{0, back * 0.42f, t},
             {handle * 0.2f, back * 0.36f, t},
             {handle * 0.7f, back * 0.46f, t * 1.15f},
             {handle, back * 0.2f, t}},
            6, 3)
        .move(length / 2, h / 2 - back / 2, 0);
}

/// length, handle width, head length, head width, bristle length, bend; handle, grip, bristles, second bristles
void toothbrush(Sculptor& s, const Design& d) {
  const float length = d[0], w = d[1], head = d[2], wide = d[3], bristle = d[4], bend = d[5];
  const float neck = length - head;
  const auto curve = [&](float x) { return bend * std::sin(std::numbers::pi_v<float> * x / neck); };
  s.use(d.look[0]);
  s.strip({{0, w * 0.35f, 4, curve(0)},
           {6, w * 0.48f, 6.5f, curve(6)},
           {neck * 0.3f, w * 0.5f, 8, curve(neck * 0.3f)},
           {neck * 0.55f, w * 0.42f, 7, curve(neck * 0.55f)},
           {neck * 0.75f, w * 0.28f, 5.5f, curve(neck * 0.75f)},
           {neck - 4, w * 0.26f, 4.5f, 0},
           {neck + head * 0.15f, wide * 0.45f, 4.5f},
           {neck + head * 0.5f, wide * 0.5f, 4.5f},
           {neck + head * 0.9f, wide * 0.42f, 4.5f},
           {neck + head, wide * 0.15f, 3}},
          6, 2.8f);
  s.use(d.look[1]);
  s.strip({{neck * 0.1f, w * 0.2f, 3, curve(neck * 0.1f) + 2.8f},
           {neck * 0.2f, w * 0.42f, 5, curve(neck * 0.2f) + 2.2f},
           {neck * 0.42f, w * 0.38f, 5, curve(neck * 0.42f) + 2},
           {neck * 0.58f, w * 0.18f, 3, curve(neck * 0.58f) + 2}},
          6, 2.4f);
  const int rows = 4, columns = static_cast<int>(head / 3.1f);
  for (int pass = 0; pass < 2; ++pass) {
    s.use(d.look[2 + static_cast<std::size_t>(pass)]);
    for (int i = 0; i < columns; ++i)
      for (int k = 0; k < rows; ++k) {
        if ((i / 2) % 2 != pass) continue;
        const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(columns),
                    v = (static_cast<float>(k) + 0.5f) / rows * 2 - 1;
        const float high = bristle * (1 + 0.12f * std::cos(6 * std::numbers::pi_v<float> * u) -
                                      (k == 0 || k == rows - 1 ? 0.06f : 0.0f));
        s.cylinder(1.05f, high, 0.3f).move(neck + head * (0.06f + 0.86f * u), v * wide * 0.4f, high / 2 + 1.5f);
      }
  }
}

/// lens width, lens height, bridge, rim thickness, temple length, kind (0 round wire, 1 thick); frame, lenses
void glasses(Sculptor& s, const Design& d) {
  const float w = d[0], h = d[1], bridge = d[2], rim = d[3], temple = d[4];
  const float corner = d.kind(5) == 0 ? std::min(w, h) * 0.499f : std::min(w, h) * 0.32f;
  for (const float side : {-1.0f, 1.0f}) {
    const float x = side * (w + bridge) / 2;
    s.use(d.look[0]);
    const Outline lens = rounded_rectangle(w, h, corner);
    Path loop;
    for (const Vec2& p : smooth(lens, 2, true)) loop.emplace_back(p.x(), 0, p.y());
    s.tube(loop, {rim}, true, 1, 8).move(x, 0, 0);
    const float outer = side * (w + bridge / 2);
    s.tube(smooth(Path{{outer - side * 2, 0, h * 0.28f},
                       {outer + side * 5, 1, h * 0.3f},
                       {outer + side * 7, 8, h * 0.3f},
                       {outer + side * 7, temple * 0.7f, h * 0.28f},
                       {outer + side * 5, temple * 0.88f, h * 0.05f},
                       {outer + side * 4, temple, -h * 0.3f}}),
           {rim * 1.1f}, false, d.kind(5) == 0 ? 1.0f : 1.7f, 10);
    s.use(d.look[1]);
    s.plate(lens, 1.2f).turn_x(90).move(x, 0, 0);
  }
  s.use(d.look[0]);
  s.tube(smooth(Path{{-bridge / 2 - 2, 0, h * 0.15f},
                     {-bridge * 0.2f, -2, h * 0.3f},
                     {bridge * 0.2f, -2, h * 0.3f},
                     {bridge / 2 + 2, 0, h * 0.15f}}),
         {rim * 1.1f});
}

/// length, radius, kind (0 capped at its end, 1 clicker), tip length; barrel, metal, grip
void pen(Sculptor& s, const Design& d) {
  const float length = d[0], r = d[1], tip = d[3];
  const int kind = d.kind(2);
  s.use(d.look[0]);
  s.lathe({{r * 0.9f, 0}, {r, 1}, {r, length - tip - 35}, {r * 0.93f, length - tip - 34}}, 24).turn_y(90);
  s.use(d.look[2]);
  s.lathe({{r * 0.93f, length - tip - 34},
           {r * 1.04f, length - tip - 30},
           {r, length - tip - 15},
           {r * 0.85f, length - tip}},
          24)
      .turn_y(90);
  s.use(d.look[1]);
  s.lathe({{r * 0.85f, length - tip}, {r * 0.35f, length - 3}, {0.5f, length - 2}, {0.4f, length}}, 20).turn_y(90);
  s.torus(r * 0.97f, 0.8f).turn_y(90).move(length * 0.35f, 0, 0);
  if (kind == 1) s.cylinder(r * 0.5f, 12).turn_y(90).move(-5, 0, 0);
  s.plate(rounded_rectangle(38, r * 0.75f, 1), 1.1f, 0.3f).move(20, 0, r + 2.2f);
  s.box(4, r * 0.75f, 3.5f, 0.4f).move(2.5f, 0, r + 0.8f);
  s.ball(2, 1.6f, 1.3f).move(37, 0, r + 1.2f);
  if (kind == 0) {
    s.use(d.look[0]);
    s.lathe({{r * 0.9f, -2}, {r * 1.15f, 0}, {r * 1.15f, length * 0.34f}, {r, length * 0.35f}}, 24).turn_y(90);
  }
}

/// head size, shank length, thickness, bits, kind (0 flat with round head, 1 old with barrel, 2 car); metal, head
void key(Sculptor& s, const Design& d) {
  const float head = d[0], shank = d[1], t = d[2];
  const int bits = d.kind(3), kind = d.kind(4);
  s.use(d.look[0]);
  if (kind == 1) {
    s.torus(head * 0.38f, t * 0.9f).scale(1.1f, 0.85f, 1);
    s.cylinder(t, shank).turn_y(90).move(head * 0.4f + shank / 2, 0, 0);
    s.torus(t, t * 0.45f).turn_y(90).move(head * 0.5f, 0, 0);
    s.plate({{-9, 0}, {-9, -14}, {-5.5f, -14}, {-5.5f, -8}, {-3, -8}, {-3, -14}, {0, -14}, {0, 0}}, t * 0.9f, 0.3f)
        .move(head * 0.4f + shank - 3, 0, 0);
    return;
  }
  Outline blade{{0, 4}};
  blade.emplace_back(0, -3.2f);
  for (int i = 0; i < bits; ++i) {
    const float x = shank * (0.18f + 0.75f * static_cast<float>(i) / static_cast<float>(bits)),
                step = shank * 0.75f / static_cast<float>(bits);
    const float depth = 0.6f + 2.4f * static_cast<float>((i * 5 + bits) % 4) / 3;
    blade.emplace_back(x, -3.8f);
    blade.emplace_back(x + step * 0.4f, -3.8f + depth);
    blade.emplace_back(x + step * 0.6f, -3.8f + depth);
  }
  blade.emplace_back(shank * 0.94f, -3.4f);
  blade.emplace_back(shank, 0);
  blade.emplace_back(shank * 0.96f, 4);
  s.plate(blade, t, 0.25f);
  s.box(shank * 0.85f, 1.3f, t * 1.25f, 0.2f).move(shank * 0.45f, 1.6f, 0);
  s.use(d.look[1]);
  const Outline hole = moved(circle(head * 0.13f, 20), -head * 0.28f, 0);
  if (kind == 0)
    s.plate(smooth(Outline{{-head * 0.5f, 0},
                           {-head * 0.38f, -head * 0.4f},
                           {0, -head * 0.48f},
                           {head * 0.36f, -head * 0.3f},
                           {head * 0.5f, 0},
                           {head * 0.36f, head * 0.3f},
                           {0, head * 0.48f},
                           {-head * 0.38f, head * 0.4f}},
                   4, true),
            t * 1.1f, 0.4f, {hole})
        .move(-head * 0.4f, 0, 0);
  else
    s.plate(rounded_rectangle(head * 1.35f, head * 0.85f, head * 0.25f), t * 4, 1.8f,
            {moved(circle(head * 0.1f, 16), -head * 0.52f, 0)})
        .move(-head * 0.6f, 0, 0);
}

/// case radius, case height, strap width, strap length, kind (0 laid flat, 1 closed loop), square; case, dial, strap,
/// hands
void watch(Sculptor& s, const Design& d) {
  const float r = d[0], h = d[1], w = d[2], strap = d[3];
  const bool loop = d.kind(4) == 1;
  const Outline body = d.kind(5) == 1 ? rounded_rectangle(2 * r, 2 * r, r * 0.3f) : circle(r, 48);
  const Outline inner = d.kind(5) == 1 ? rounded_rectangle(1.7f * r, 1.7f * r, r * 0.25f) : circle(r * 0.85f, 48);
  s.use(d.look[0]);
  s.plate(body, h, 1.2f);
  Path bezel;
  for (const Vec2& p : inner) bezel.emplace_back(p.x(), p.y(), h / 2);
  s.tube(bezel, {1.3f}, true, 1, 8);
  s.cylinder(2.3f, 4).turn_y(90).move(r + 1.5f, 0, 0);
  for (const float side : {-1.0f, 1.0f}) s.box(w + 4, 6, h * 0.55f, 1).move(0, side * (r + 1), -h * 0.15f);
  s.use(d.look[1]);
  s.plate(inner, 0.6f).move(0, 0, h / 2 + 0.1f);
  s.use(d.look[3]);
  for (int hour = 0; hour < 12; ++hour)
    s.box(1.1f, hour % 3 == 0 ? 3.6f : 2.0f, 0.5f, 0.1f)
        .move(0, r * 0.7f, h / 2 + 0.6f)
        .turn_z(30.0f * static_cast<float>(hour));
  s.box(1.5f, r * 0.45f, 0.5f, 0.1f).move(0, r * 0.2f, h / 2 + 0.9f).turn_z(-60);
  s.box(1, r * 0.62f, 0.5f, 0.1f).move(0, r * 0.3f, h / 2 + 1.2f).turn_z(45);
  s.use(d.look[2]);
  const auto band = [&](float side) {  // a flat bar bent around the wrist, or laid out
    const float reach = side > 0 ? strap : strap * 0.85f;
    std::vector<Path> rings;
    for (int i = 0; i <= 24; ++i) {
      const float t = static_cast<float>(i) / 24, narrow = w / 2 * (1 - 0.18f * t);
      const float angle = loop ? std::numbers::pi_v<float> * 1.02f * t : 0.5f * t * t;
      const float round = loop ? (strap * 0.9f + r) / std::numbers::pi_v<float> : 1e6f;
      const Vec3 at =
          loop ? Vec3(0, side * (r * 0.6f + round * std::sin(angle) * 0.9f), -round * (1 - std::cos(angle)) - 1)
               : Vec3(0, side * (r + reach * t), -h * 0.15f - 1.5f * std::sin(std::numbers::pi_v<float> * t));
      const Vec3 out = loop ? Vec3(0, side * std::sin(angle), std::cos(angle)) : Vec3(0, 0, 1);
      const float half = 1.4f;
      Path ring{at + Vec3(-narrow, 0, 0) - half * out, at + Vec3(narrow, 0, 0) - half * out,
                at + Vec3(narrow, 0, 0) + half * out, at + Vec3(-narrow, 0, 0) + half * out};
      if (side > 0) std::reverse(ring.begin(), ring.end());
      rings.push_back(std::move(ring));
    }
    s.loft(rings);
  };
  band(1);
  band(-1);
  s.use(d.look[0]);
  if (!loop)
    s.tube({{-w * 0.5f, -r - strap * 0.85f, -1},
            {w * 0.5f, -r - strap * 0.85f, -1},
            {w * 0.5f, -r - strap * 0.85f - 9, -1},
            {-w * 0.5f, -r - strap * 0.85f - 9, -1}},
           {1.3f}, true, 1, 8);
}

}  // namespace

std::vector<CategoryDesigns> personal_designs() {
  return {
      {"comb",
       comb,
       {{{130, 32, 11, 44, 3.5f, 0}, {black()}},
        {{115, 36, 12, 26, 4, 0}, {red()}},
        {{105, 34, 11, 32, 4, 75}, {teal()}},
        {{170, 38, 14, 40, 4, 0}, {plastic(0.3f, 0.11f, 0.03f)}},
        {{90, 40, 16, 18, 5, 90}, {beech()}}}},
      {"toothbrush",
       toothbrush,
       {{{180, 13, 28, 11.5f, 11, 3}, {white(), blue(), white(), blue()}},
        {{190, 14, 30, 12, 11, 6}, {red(), white(), white(), red()}},
        {{170, 12, 26, 11, 10, 0}, {green(), green(), white(), white()}},
        {{185, 12, 29, 12, 11, 2}, {beech(), beech(), matte(0.7f, 0.62f, 0.45f), matte(0.7f, 0.62f, 0.45f)}},
        {{160, 16, 25, 11, 10, 4}, {yellow(), purple(), white(), teal()}}}},
      {"glasses",
       glasses,
       {{{46, 42, 20, 1.4f, 130, 0}, {brass(), clear(0.92f, 0.94f, 0.94f, 0.9f)}},
        {{52, 38, 18, 2.4f, 140, 1}, {black(), clear(0.92f, 0.94f, 0.94f, 0.9f)}},
        {{54, 46, 16, 2, 135, 1}, {plastic(0.25f, 0.08f, 0.03f), clear(0.12f, 0.09f, 0.06f, 0.35f)}},
        {{48, 30, 18, 1.8f, 132, 1}, {blue(), clear(0.92f, 0.94f, 0.94f, 0.9f)}},
        {{56, 48, 15, 2.6f, 138, 1}, {red(), clear(0.05f, 0.05f, 0.06f, 0.25f)}}}},
      {"pen",
       pen,
       {{{140, 5, 1, 12}, {blue(), chrome(), black()}},
        {{145, 4.6f, 0, 10}, {plastic(0.7f, 0.6f, 0.02f), black(), plastic(0.7f, 0.6f, 0.02f)}},
        {{138, 6, 0, 16}, {black(), brass(), black()}},
        {{142, 5.5f, 1, 14}, {metal(0.5f, 0.05f, 0.08f, 60), chrome(), grey()}},
        {{135, 6.5f, 1, 10}, {white(), orange(), orange()}}}},
      {"key",
       key,
       {{{26, 30, 2.2f, 5, 0}, {brass(), brass()}},
        {{24, 28, 2, 6, 0}, {steel(), steel()}},
        {{34, 62, 3.2f, 2, 1}, {iron(), iron()}},
        {{34, 40, 2.2f, 6, 2}, {steel(), black()}},
        {{30, 33, 2.4f, 5, 0}, {steel(), red()}}}},
      {"watch",
       watch,
       {{{20, 10, 20, 90, 0, 0}, {chrome(), white(), plastic(0.18f, 0.08f, 0.03f), black()}},
        {{22, 12, 22, 85, 1, 0}, {steel(), black(), steel(), white()}},
        {{17, 9, 16, 80, 0, 1}, {brass(), plastic(0.7f, 0.68f, 0.55f), black(), black()}},
        {{21, 13, 22, 85, 1, 1}, {black(), plastic(0.05f, 0.2f, 0.12f), black(), white()}},
        {{19, 9, 18, 88, 0, 0}, {brass(), plastic(0.05f, 0.1f, 0.3f), red(), white()}}}},
  };
}

}  // namespace svnet::simulation
