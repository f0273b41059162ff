#include <cmath>

#include "simulation/catalogue/designs.h"
#include "simulation/catalogue/looks.h"

namespace svnet::simulation {
namespace {

using namespace looks;

/// blade length, blade height, thickness, handle length, handle height, kind (0 chef, 1 table, 2 bread); handle, blade,
/// rivets
void knife(Sculptor& s, const Design& d) {
  const float blade = d[0], h = d[1], t = d[2], handle = d[3], grip = d[4];
  const int kind = d.kind(5);
  s.use(d.look[1]);
  Outline edge;
  if (kind == 1)
    edge = smooth(Outline{{0, -h * 0.35f},
                          {blade * 0.4f, -h * 0.5f},
                          {blade * 0.8f, -h * 0.45f},
                          {blade, 0.1f * h},
                          {blade * 0.93f, h * 0.42f},
                          {blade * 0.5f, h * 0.42f},
                          {0, h * 0.35f}},
                  6);
  else
    edge =
        smooth(Outline{{0, -h * 0.5f}, {blade * 0.45f, -h * 0.5f}, {blade * 0.8f, -h * 0.25f}, {blade, h * 0.3f}}, 6);
  if (kind == 2) {  // serrated
    for (std::size_t i = 1; i + 1 < edge.size(); ++i) edge[i].y() += i % 2 == 0 ? h * 0.06f : 0;
  }
  if (kind != 1)
    edge.emplace_back(blade * 0.97f, h * 0.42f), edge.emplace_back(blade * 0.7f, h * 0.5f),
        edge.emplace_back(0, h * 0.5f);
  s.plate(edge, t, t * 0.4f).bend([&](Vec3 p) {
    return Vec3(p.x(), p.y(), p.z() * std::clamp((p.y() + h * 0.55f) / (h * 0.8f), 0.15f, 1.0f));
  });
  s.plate(rounded_rectangle(handle * 0.3f, std::min(h, grip) * 0.8f, 1), t * 2.2f, 0.8f)
      .move(-handle * 0.03f, h * 0.1f, 0);
  s.use(d.look[0]);
  const float bulge = kind == 1 ? 0.8f : 1;
  s.strip({{-handle, grip * 0.5f, t * 4},
           {-handle * 0.85f, grip * 0.58f, t * 6 * bulge},
           {-handle * 0.45f, grip * 0.45f, t * 7 * bulge},
           {-handle * 0.12f, grip * 0.5f, t * 6 * bulge},
           {0, grip * 0.46f, t * 4}},
          6, 3)
      .move(0, h * 0.1f, 0);
  s.use(d.look[2]);
  if (kind != 1)
    for (const float x : {0.2f, 0.5f, 0.8f}) s.cylinder(3, t * 7.4f).move(-handle * x, h * 0.1f, 0);
}

/// length, bowl length, bowl width, handle width, depth; metal
void spoon(Sculptor& s, const Design& d) {
  const float length = d[0], bowl = d[1], w = d[2], handle = d[3], dish = d[4];
  s.use(d.look[0]);
  s.strip({{-length + bowl, handle * 0.4f, 2.2f, 6},
           {-length + bowl + 8, handle * 0.62f, 2.4f, 6},
           {-length * 0.55f + bowl, handle * 0.42f, 2.6f, 9},
           {-10, handle * 0.3f, 3, 7},
           {2, handle * 0.36f, 2.6f, 2, 0},
           {bowl * 0.25f, w * 0.4f, 2, -0.5f, dish * 0.7f},
           {bowl * 0.55f, w * 0.5f, 1.8f, -1, dish},
           {bowl * 0.82f, w * 0.38f, 1.8f, 0, dish * 0.7f},
           {bowl * 0.96f, w * 0.2f, 1.8f, 1, dish * 0.2f},
           {bowl, w * 0.03f, 1.5f, 1.5f, 0}},
          7, 2.2f);
}

/// length, tine length, width, handle width, tines; metal
void fork(Sculptor& s, const Design& d) {
  const float length = d[0], tine = d[1], w = d[2], handle = d[3];
  const int tines = d.kind(4);
  s.use(d.look[0]);
  s.strip({{-length + tine, handle * 0.4f, 2.2f, 6},
           {-length + tine + 8, handle * 0.6f, 2.4f, 6},
           {-length * 0.55f + tine, handle * 0.42f, 2.6f, 9},
           {-34, handle * 0.3f, 3, 6},
           {-22, handle * 0.45f, 2.6f, 2},
           {-10, w * 0.5f, 2.2f, -1},
           {1.5f, w * 0.5f, 2, -2}},
          7, 3);
  for (int i = 0; i < tines; ++i) {
    const float u = 2 * static_cast<float>(i) / static_cast<float>(tines - 1) - 1,
                half = w / static_cast<float>(tines) * 0.29f;
    s.strip({{0, half, 2, -1.8f},
             {tine * 0.4f, half, 2, -2.5f},
             {tine * 0.8f, half * 0.9f, 1.8f, 0.5f},
             {tine, half * 0.35f, 1, 4}},
            5, 3)
        .move(0, u * (w * 0.5f - half), 0);
  }
}

/// bowl radius, bowl depth, handle length, handle width, kind (0 hooked, 1 wooden handle); metal, handle
void ladle(Sculptor& s, const Design& d) {
  const float r = d[0], depth = d[1], length = d[2], w = d[3];
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{0, -depth},
                         {r * 0.6f, -depth * 0.85f},
                         {r * 0.92f, -depth * 0.4f},
                         {r, 0},
                         {r - 1.5f, 0.5f},
                         {r * 0.9f, -depth * 0.38f},
                         {r * 0.57f, -depth * 0.8f},
                         {0, -depth + 2}},
                 5),
          48);
  const Path rise = smooth(Path{{r - 2, 0, -3},
                                {r + 6, 0, 8},
                                {r + length * 0.25f, 0, length * 0.2f},
                                {r + length * 0.6f, 0, length * 0.33f},
                                {r + length, 0, length * 0.42f}});
  s.tube(rise, {w * 0.5f}, false, 0.35f);
  const Vec3 end = rise.back();
  if (d.kind(4) == 0) {
    s.tube(smooth(Path{end, end + Vec3(14, 0, 3), end + Vec3(19, 0, -6), end + Vec3(8, 0, -14)}), {w * 0.42f}, false,
           0.35f);
  } else {
    s.use(d.look[1]);
    s.tube(Path(rise.end() - 14, rise.end()), {w * 0.75f, w * 0.9f, w, w, w, w, w, w, w, w, w, w, w * 0.95f, w * 0.7f},
           false, 0.7f);
  }
}

/// radius, height, wall slope, handle length, handle width, kind (0 plain handle, 1 loop at its end); body, inside,
/// handle
void pan(Sculptor& s, const Design& d) {
  const float r = d[0], h = d[1], slope = d[2], handle = d[3], w = d[4];
  s.use(d.look[0]);
  s.lathe(smooth(Outline{{0, 0},
                         {r - slope - 4, 0},
                         {r - slope, 2},
                         {r - 1, h * 0.85f},
                         {r + 2, h},
                         {r, h + 1},
                         {r - 3, h * 0.85f}},
                 4),
          64);
  s.use(d.look[1]);
  s.lathe(smooth(Outline{{0, 2.2f},
                         {r - slope - 5, 2.6f},
                         {r - slope - 2, 4},
                         {r - 1.5f, h * 0.9f},
                         {r, h + 0.8f},
                         {r - 2.5f, h * 0.86f},
                         {r - slope - 3, 4.5f},
                         {r - slope - 8, 3},
                         {0, 3}},
                 4),
          64);
  s.use(d.look[2]);
  const float y = h * 0.8f;
  s.strip({{r - 3, w * 0.3f, 6, y},
           {r + 15, w * 0.35f, 7, y + 5},
           {r + handle * 0.4f, w * 0.45f, 11, y + 16},
           {r + handle * 0.8f, w * 0.55f, 13, y + 20},
           {r + handle, w * 0.35f, 9, y + 20}},
          7, 2.6f);
  if (d.kind(5) == 1) s.torus(w * 0.4f, 2.5f).move(r + handle + w * 0.3f, 0, y + 20);
  s.use(d.look[0]);
  for (const float side : {-1.0f, 1.0f}) s.ball(4, 4, 3).move(r - 4, side * w * 0.25f, y * 0.8f);
}

}  // namespace

std::vector<CategoryDesigns> cutlery_designs() {
  return {
      {"knife",
       knife,
       {{{180, 38, 2.4f, 110, 22, 0}, {black(), steel(), chrome()}},
        {{110, 18, 2, 100, 15, 1}, {chrome(), chrome(), chrome()}},
        {{200, 30, 2.2f, 115, 23, 2}, {walnut(), steel(), brass()}},
        {{130, 26, 2.2f, 105, 20, 0}, {red(), chrome(), chrome()}},
        {{95, 21, 2, 95, 18, 0}, {beech(), steel(), brass()}}}},
      {"spoon",
       spoon,
       {{{195, 62, 42, 17, 8}, {chrome()}},
        {{135, 45, 30, 12, 6}, {steel()}},
        {{210, 70, 50, 22, 10}, {beech()}},
        {{175, 58, 38, 15, 8}, {brass()}},
        {{160, 52, 36, 15, 7}, {white()}}}},
      {"fork",
       fork,
       {{{195, 50, 26, 17, 4}, {chrome()}},
        {{150, 40, 20, 13, 3}, {steel()}},
        {{215, 58, 28, 19, 4}, {metal(0.6f, 0.6f, 0.62f, 30)}},
        {{180, 46, 25, 16, 4}, {brass()}},
        {{165, 44, 25, 15, 4}, {white()}}}},
      {"ladle",
       ladle,
       {{{45, 36, 220, 13, 0}, {chrome(), black()}},
        {{40, 28, 200, 12, 1}, {steel(), black()}},
        {{38, 34, 230, 15, 0}, {black(), black()}},
        {{48, 32, 210, 13, 1}, {steel(), beech()}},
        {{36, 26, 180, 12, 0}, {red(), red()}}}},
      {"pan",
       pan,
       {{{120, 42, 18, 160, 26, 0}, {black(), matte(0.03f, 0.03f, 0.03f), black()}},
        {{100, 55, 4, 140, 24, 1}, {chrome(), steel(), chrome()}},
        {{130, 35, 24, 170, 28, 0}, {red(), matte(0.05f, 0.05f, 0.05f), black()}},
        {{85, 62, 3, 130, 22, 0}, {aluminium(), aluminium(), beech()}},
        {{110, 38, 20, 130, 27, 1}, {iron(), iron(), iron()}}}},
  };
}

}  // namespace svnet::simulation
