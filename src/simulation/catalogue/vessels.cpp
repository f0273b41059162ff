#include <cmath>

#include "simulation/catalogue/designs.h"
#include "simulation/catalogue/looks.h"

namespace svnet::simulation {
namespace {

using namespace looks;

/// An open vessel: the outer profile from its foot's rim to its lip, and the same inside, `wall` thinner.
Part vessel(Sculptor& s, const Outline& outer, float wall, float bottom) {
  Outline profile{{0, outer.front().y()}};
  profile.insert(profile.end(), outer.begin(), outer.end());
  for (auto point = outer.rbegin(); point != outer.rend(); ++point)
    if (point->y() > bottom)
      profile.emplace_back(std::max(point->x() - wall, 0.1f), point->y() + (point == outer.rbegin() ? 0.3f : 0.0f));
  const float inside = profile.back().x();
  profile.emplace_back(inside * 0.8f, bottom);
  profile.emplace_back(0, bottom);
  return s.lathe(profile, 56);
}

/// bottom radius, top radius, height, handle reach, bulge, kind of handle (0 round, 1 square); body, handle, band
void mug(Sculptor& s, const Design& d) {
  const float r0 = d[0], r1 = d[1], h = d[2], reach = d[3], bulge = d[4];
  s.use(d.look[0]);
  const auto radius = [&](float t) { return r0 + (r1 - r0) * t + bulge * std::sin(3.1416f * t); };
  Outline outer{{r0 - 3, 0}};
  for (int i = 0; i <= 12; ++i)
    outer.emplace_back(radius(static_cast<float>(i) / 12), 2 + (h - 2) * static_cast<float>(i) / 12);
  vessel(s, outer, 3.5f, 5);
  s.use(d.look[1]);
  const float x = radius(0.5f) - 2, low = h * 0.22f, high = h * 0.8f;
  if (d.kind(5) == 0)
    s.tube(smooth(Path{{radius(0.8f) - 3, 0, high},
                       {x + reach * 0.75f, 0, high + 2},
                       {x + reach, 0, h * 0.55f},
                       {x + reach * 0.7f, 0, low + 4},
                       {radius(0.2f) - 3, 0, low}}),
           {5.5f}, false, 0.75f);
  else
    s.tube(smooth(Path{{radius(0.85f) - 3, 0, high},
                       {x + reach * 0.9f, 0, high},
                       {x + reach, 0, high - 4},
                       {x + reach, 0, low + 4},
                       {x + reach * 0.9f, 0, low},
                       {radius(0.2f) - 3, 0, low}}),
           {5}, false, 1);
  s.use(d.look[2]);
  s.hoop({{radius(0.3f) - 1, 2 + (h - 2) * 0.3f},
          {radius(0.3f) + 0.4f, 2 + (h - 2) * 0.3f},
          {radius(0.5f) + 0.4f, 2 + (h - 2) * 0.5f},
          {radius(0.5f) - 1, 2 + (h - 2) * 0.5f}},
         56);
}

/// radius, body height, neck radius, total height, shoulder; body, cap, label
void bottle(Sculptor& s, const Design& d) {
  const float r = d[0], body = d[1], neck = d[2], h = d[3], shoulder = d[4];
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{0, 3},
                         {r * 0.7f, 1},
                         {r * 0.92f, 0},
                         {r, 6},
                         {r, body * 0.5f},
                         {r, body},
                         {r * 0.8f + neck * 0.2f, body + shoulder * 0.55f},
                         {neck, body + shoulder},
                         {neck, h - 18},
                         {neck, h - 12}},
                 5),
          48);
  s.hoop({{neck * 1.2f, h - 26}, {neck * 1.35f, h - 24}, {neck * 1.2f, h - 22}}, 40);
  s.use(d.look[1]);
  s.lathe({{neck * 1.1f, h - 20}, {neck * 1.18f, h - 19}, {neck * 1.15f, h - 1.5f}, {neck, h}}, 32).bend([&](Vec3 p) {
    const float ridge = 1 + 0.03f * std::cos(32 * std::atan2(p.y(), p.x()));
    return Vec3(p.x() * ridge, p.y() * ridge, p.z());
  });
  s.use(d.look[2]);
  s.hoop({{r - 1, body * 0.3f}, {r + 0.5f, body * 0.3f}, {r + 0.5f, body * 0.8f}, {r - 1, body * 0.8f}}, 48);
}

/// foot radius, rim radius, height, curve (1 round, less steeper), rim band; body, inside
void bowl(Sculptor& s, const Design& d) {
  const float foot = d[0], rim = d[1], h = d[2], curve = d[3];
  s.use(d.look[0]);
  Outline outer{{foot - 3, 0}, {foot, 0}, {foot, 5}};
  for (int i = 1; i <= 12; ++i) {
    const float t = static_cast<float>(i) / 12;
    outer.emplace_back(foot + (rim - foot) * std::pow(t, curve), 5 + (h - 5) * t);
  }
  vessel(s, outer, 3.5f, 9);
  s.use(d.look[1]);
  s.hoop({{rim - 4, h - d[4]}, {rim + 0.5f, h - d[4]}, {rim + 0.8f, h + 0.5f}, {rim - 4, h + 0.6f}}, 56);
}

/// radius, height, stem height, foot radius, kind (0 tumbler, 1 wine, 2 flute); glass
void glass(Sculptor& s, const Design& d) {
  const float r = d[0], h = d[1], stem = d[2], foot = d[3];
  s.use(d.look[0]);
  if (d.kind(4) == 0) {
    vessel(s, {{foot - 2, 0}, {foot, 2}, {foot + (r - foot) * 0.5f, h * 0.5f}, {r, h}}, 2.5f, 9);
    return;
  }
  const float belly = d.kind(4) == 1 ? 1.12f : 1.04f;
  const Outline outer = smooth(Outline{{3, stem},
                                       {r * 0.6f, stem + (h - stem) * 0.1f},
                                       {r * belly, stem + (h - stem) * 0.42f},
                                       {r * (belly + 0.04f) * 0.97f, stem + (h - stem) * 0.62f},
                                       {r * 0.93f, h}},
                               5);
  vessel(s, outer, 1.6f, stem + 4);
  s.lathe(smooth(Outline{{0, 0},
                         {foot - 1, 0},
                         {foot, 1.2f},
                         {foot * 0.6f, 3},
                         {4.5f, 8},
                         {3.2f, stem * 0.5f},
                         {3.5f, stem - 2},
                         {6, stem + 3},
                         {0, stem + 4}},
                 4),
          40);
}

/// radius, height, kind (0 drink, 1 food, 2 flat); sheet metal, label, second label
void can(Sculptor& s, const Design& d) {
  const float r = d[0], h = d[1];
  const int kind = d.kind(2);
  const float taper = kind == 0 ? r * 0.17f : 0.5f, lip = kind == 0 ? 9.0f : 3.0f;
  s.use(d.look[0]);
  s.lathe({{0, 5},
           {r - taper - 5, 5},
           {r - taper - 2.5f, 0},
           {r - taper, 1},
           {r, lip},
           {r, h - lip * 1.3f},
           {r - taper, h - 2},
           {r - taper + 1.2f, h},
           {r - taper - 1, h},
           {r - taper - 2, h - 4},
           {0, h - 4}},
          56);
  if (kind != 0)
    for (int i = 1; i < 4; ++i) s.torus(r * 0.2f * static_cast<float>(i) + r * 0.1f, 0.7f).move(0, 0, h - 4);
  s.use(d.look[1]);
  const auto band = [&](float low, float high, float out) {
    s.hoop({{r - 1, low}, {r + out, low}, {r + out, high}, {r - 1, high}}, 56);
  };
  band(lip + 1, h - lip * 1.3f - 1, 0.3f);
  s.use(d.look[2]);
  band(h * 0.4f, h * 0.62f, 0.5f);
  s.use(d.look[0]);
  if (kind == 0) {
    s.plate(rounded_rectangle(15, 10, 4.9f), 1.2f, 0.3f, {moved(rounded_rectangle(5, 6, 2.4f), 3, 0)})
        .move(7, 0, h - 2.5f);
    s.use(black());
    s.plate(rounded_rectangle(14, 11, 5), 0.4f).move(-9, 0, h - 3.9f);
  } else if (kind == 2) {
    s.torus(8, 1.2f).move(r * 0.45f, 0, h - 2.5f);
  }
}

/// radius, height, rim width, foot radius; glaze, rim, centre
void plate(Sculptor& s, const Design& d) {
  const float r = d[0], h = d[1], rim = d[2], foot = d[3];
  s.use(d.look[0]);
  const float well = r - rim;
  s.lathe(smooth(Outline{{0, 3},
                         {foot - 4, 3},
                         {foot - 3, 0},
                         {foot, 0},
                         {foot + 3, 4},
                         {well, h * 0.45f},
                         {r - 2, h - 2},
                         {r, h},
                         {r - 3, h + 0.8f},
                         {well, h * 0.45f + 4.5f},
                         {well - 10, 7},
                         {0, 6}},
                 4),
          72);
  s.use(d.look[1]);
  s.hoop({{r - 9, h - 4}, {r + 0.4f, h - 1}, {r + 0.4f, h + 0.8f}, {r - 3, h + 1.3f}, {r - 9, h - 0.4f}}, 72);
  s.use(d.look[2]);
  s.cylinder(well * 0.45f, 1.2f, 0.4f).move(0, 0, 6.2f);
}

/// body radius, squeeze, height, neck radius, head length; body, head, trigger, label
void spray_bottle(Sculptor& s, const Design& d) {
  const float r = d[0], squeeze = d[1], h = d[2], neck = d[3], head = d[4];
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{0, 2},
                         {r * 0.85f, 0},
                         {r, 5},
                         {r, h * 0.35f},
                         {r * 0.96f, h * 0.6f},
                         {r * 0.75f, h * 0.82f},
                         {neck * 1.1f, h * 0.95f},
                         {neck, h}},
                 5),
          48)
      .scale(1, squeeze, 1);
  s.use(d.look[3]);
  s.hoop({{r - 2, h * 0.12f}, {r + 0.6f, h * 0.12f}, {r + 0.6f, h * 0.45f}, {r - 2, h * 0.45f}}, 48)
      .scale(1, squeeze, 1);
  s.use(d.look[1]);
  s.cylinder(neck * 1.25f, 18, 1).move(0, 0, h + 6);
  s.plate({{-neck * 1.5f, 14},
           {neck * 0.7f, 12},
           {neck * 0.8f, 28},
           {head * 0.75f, 36},
           {head * 0.8f, 50},
           {-neck * 1.2f, 52},
           {-neck * 2.1f, 40}},
          neck * 1.7f, 3)
      .turn_x(90)
      .move(0, 0, h);
  s.cylinder(6, 12, 1).turn_y(90).move(head * 0.85f, 0, h + 43);
  s.use(d.look[2]);
  s.tube(smooth(Path{
             {neck * 1.3f, 0, h + 32}, {neck * 1.9f, 0, h + 18}, {neck * 1.7f, 0, h + 4}, {neck * 2.2f, 0, h - 14}}),
         {5.5f, 5.5f, 5, 5, 5, 5, 5, 5, 5, 5, 4.5f, 4}, false, 0.8f);
  s.cylinder(4, 6, 0.5f).turn_y(90).move(head * 0.85f + 8, 0, h + 43);
}

}  // namespace

std::vector<CategoryDesigns> vessel_designs() {
  return {
      {"mug",
       mug,
       {{{40, 41, 95, 32, 0, 0}, {ceramic(0.8f, 0.8f, 0.78f), ceramic(0.8f, 0.8f, 0.78f), ceramic(0.1f, 0.2f, 0.5f)}},
        {{36, 44, 85, 30, 3, 0},
         {ceramic(0.5f, 0.05f, 0.04f), ceramic(0.5f, 0.05f, 0.04f), ceramic(0.75f, 0.7f, 0.6f)}},
        {{42, 39, 75, 33, 5, 0},
         {ceramic(0.08f, 0.25f, 0.22f), ceramic(0.08f, 0.25f, 0.22f), ceramic(0.06f, 0.18f, 0.16f)}},
        {{38, 38, 105, 34, 0, 1},
         {ceramic(0.03f, 0.03f, 0.035f), ceramic(0.03f, 0.03f, 0.035f), ceramic(0.7f, 0.5f, 0.1f)}},
        {{35, 42, 80, 28, 0, 1}, {steel(), black(), steel()}}}},
      {"bottle",
       bottle,
       {{{34, 130, 13, 240, 60}, {clear(0.55f, 0.75f, 0.9f, 0.6f), blue(), plastic(0.75f, 0.8f, 0.85f)}},
        {{37, 170, 14, 300, 60},
         {clear(0.04f, 0.13f, 0.05f, 0.25f), metal(0.4f, 0.05f, 0.08f, 40), matte(0.75f, 0.72f, 0.6f)}},
        {{31, 120, 12.5f, 220, 55}, {clear(0.28f, 0.11f, 0.02f, 0.3f), brass(), matte(0.6f, 0.1f, 0.05f)}},
        {{42, 120, 17, 200, 45}, {plastic(0.75f, 0.76f, 0.72f), red(), green()}},
        {{36, 180, 22, 250, 30}, {metal(0.1f, 0.3f, 0.42f, 40), black(), metal(0.1f, 0.3f, 0.42f, 40)}}}},
      {"bowl",
       bowl,
       {{{35, 75, 62, 0.5f, 4}, {ceramic(0.8f, 0.79f, 0.75f), ceramic(0.1f, 0.15f, 0.4f)}},
        {{40, 95, 55, 0.6f, 3}, {ceramic(0.55f, 0.25f, 0.1f), ceramic(0.4f, 0.16f, 0.06f)}},
        {{30, 65, 70, 0.4f, 5}, {ceramic(0.12f, 0.3f, 0.2f), ceramic(0.7f, 0.68f, 0.6f)}},
        {{45, 110, 80, 0.55f, 3}, {steel(), chrome()}},
        {{38, 85, 75, 0.7f, 6}, {plastic(0.75f, 0.45f, 0.05f), plastic(0.8f, 0.55f, 0.1f)}}}},
      {"glass",
       glass,
       {{{36, 110, 0, 30, 0}, {clear(0.9f, 0.93f, 0.94f)}},
        {{38, 200, 90, 36, 1}, {clear(0.92f, 0.93f, 0.93f)}},
        {{25, 220, 95, 33, 2}, {clear(0.92f, 0.93f, 0.9f)}},
        {{41, 88, 0, 38, 0}, {clear(0.55f, 0.75f, 0.9f, 0.75f)}},
        {{42, 170, 70, 38, 1}, {clear(0.7f, 0.85f, 0.7f, 0.78f)}}}},
      {"can",
       can,
       {{{33, 115, 0}, {aluminium(), metal(0.6f, 0.03f, 0.04f, 40), white()}},
        {{37, 110, 1}, {steel(), matte(0.75f, 0.5f, 0.08f), matte(0.5f, 0.05f, 0.03f)}},
        {{42, 55, 2}, {steel(), matte(0.1f, 0.3f, 0.5f), matte(0.75f, 0.75f, 0.7f)}},
        {{29, 135, 0}, {aluminium(), metal(0.05f, 0.2f, 0.5f, 40), metal(0.75f, 0.75f, 0.78f, 60)}},
        {{50, 120, 1}, {steel(), matte(0.1f, 0.35f, 0.1f), matte(0.7f, 0.1f, 0.06f)}}}},
      {"plate",
       plate,
       {{{130, 22, 32, 75}, {ceramic(0.8f, 0.79f, 0.76f), ceramic(0.8f, 0.79f, 0.76f), ceramic(0.8f, 0.79f, 0.76f)}},
        {{105, 18, 26, 60}, {ceramic(0.8f, 0.79f, 0.76f), ceramic(0.08f, 0.14f, 0.45f), ceramic(0.55f, 0.6f, 0.75f)}},
        {{120, 30, 18, 65}, {ceramic(0.12f, 0.26f, 0.28f), ceramic(0.3f, 0.18f, 0.1f), ceramic(0.15f, 0.3f, 0.32f)}},
        {{90, 16, 22, 55}, {ceramic(0.65f, 0.3f, 0.15f), ceramic(0.4f, 0.15f, 0.06f), ceramic(0.65f, 0.3f, 0.15f)}},
        {{115, 20, 14, 72},
         {ceramic(0.05f, 0.05f, 0.055f), ceramic(0.05f, 0.05f, 0.055f), ceramic(0.05f, 0.05f, 0.055f)}}}},
      {"spray_bottle",
       spray_bottle,
       {{{40, 0.7f, 160, 13, 50}, {clear(0.4f, 0.65f, 0.9f, 0.5f), white(), red(), matte(0.75f, 0.75f, 0.3f)}},
        {{36, 0.9f, 180, 12, 46}, {white(), green(), green(), matte(0.1f, 0.45f, 0.15f)}},
        {{45, 0.6f, 150, 14, 52}, {plastic(0.7f, 0.35f, 0.02f), white(), white(), matte(0.8f, 0.78f, 0.7f)}},
        {{38, 1, 140, 13, 44}, {clear(0.85f, 0.88f, 0.88f, 0.6f), black(), black(), matte(0.8f, 0.8f, 0.8f)}},
        {{42, 0.75f, 190, 13, 54}, {plastic(0.08f, 0.2f, 0.55f), white(), yellow(), matte(0.75f, 0.75f, 0.75f)}}}},
  };
}

}  // namespace svnet::simulation
