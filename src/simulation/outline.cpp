// Smooth curves and plane outlines, and their triangulation by ear clipping (Meisters, "Polygons have ears", 1975),
// holes joined to the outline by bridges first (Eberly, "Triangulation by ear clipping").
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "simulation/sculptor.h"

namespace svnet::simulation {
namespace {

template <class Points>
Points smoothed(const Points& points, int steps, bool loop) {
  const auto n = static_cast<int>(points.size());
  const auto at = [&](int i) { return points[static_cast<std::size_t>(loop ? (i + n) % n : std::clamp(i, 0, n - 1))]; };
  Points result;
  for (int i = 0; i < (loop ? n : n - 1); ++i)
    for (int k = 0; k < steps; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(steps), t2 = t * t, t3 = t2 * t;
      result.push_back(0.5f * (2 * at(i) + (at(i + 1) - at(i - 1)) * t +
                               (2 * at(i - 1) - 5 * at(i) + 4 * at(i + 1) - at(i + 2)) * t2 +
                               (3 * at(i) - at(i - 1) - 3 * at(i + 1) + at(i + 2)) * t3));
    }
  if (!loop) result.push_back(points.back());
  return result;
}

float cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

bool inside(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

/// Whether the segments cross at a point inside both.
bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return (cross(a, b, c) > 0) != (cross(a, b, d) > 0) && (cross(c, d, a) > 0) != (cross(c, d, b) > 0);
}

}  // namespace

Outline smooth(const Outline& points, int steps, bool loop) { return smoothed(points, steps, loop); }
Path smooth(const Path& points, int steps, bool loop) { return smoothed(points, steps, loop); }

Outline circle(float radius, int segments) {
  Outline outline;
  for (int i = 0; i < segments; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(segments);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

Outline rounded_rectangle(float x, float y, float radius) {
  Outline outline;
  for (int corner = 0; corner < 4; ++corner)
    for (int i = 0; i <= 4; ++i) {
      const float angle = std::numbers::pi_v<float> / 2 * (static_cast<float>(corner) + static_cast<float>(i) / 4);
      const float sx = corner == 0 || corner == 3 ? 1.0f : -1.0f, sy = corner < 2 ? 1.0f : -1.0f;
      outline.emplace_back(sx * (x / 2 - radius) + radius * std::cos(angle),
                           sy * (y / 2 - radius) + radius * std::sin(angle));
    }
  return outline;
}

Outline moved(Outline outline, float x, float y) {
  for (Vec2& point : outline) point += Vec2(x, y);
  return outline;
}

std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline, const std::vector<Outline>& holes) {
  Outline points = outline;
  std::vector<std::uint32_t> loop(outline.size());
  std::iota(loop.begin(), loop.end(), 0u);
  struct Hole {
    std::uint32_t first, count;
    float right;
  };
  std::vector<Hole> order;
  for (const Outline& hole : holes) {
    order.push_back({static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(hole.size()),
                     (*std::max_element(hole.begin(), hole.end(), [](const Vec2& a, const Vec2& b) {
                       return a.x() < b.x();
                     })).x()});
    points.insert(points.end(), hole.begin(), hole.end());
  }
  std::sort(order.begin(), order.end(), [](const Hole& a, const Hole& b) { return a.right > b.right; });
  for (std::size_t h = 0; h < order.size(); ++h) {
    // The shortest bridge between the hole and the loop that crosses no edge of either, nor of the holes to come.
    const auto blocked = [&](std::uint32_t a, std::uint32_t b) {
      const auto crosses = [&](std::uint32_t c, std::uint32_t d) {
        return c != a && c != b && d != a && d != b && points[c] != points[a] && points[d] != points[a] &&
               cross_each_other(points[a], points[b], points[c], points[d]);
      };
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (crosses(loop[i], loop[(i + 1) % loop.size()])) return true;
      for (std::size_t other = h; other < order.size(); ++other)
        for (std::uint32_t i = 0; i < order[other].count; ++i)
          if (crosses(order[other].first + i, order[other].first + (i + 1) % order[other].count)) return true;
      return false;
    };
    std::size_t best_loop = 0;
    std::uint32_t best_hole = 0;
    float best = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < loop.size(); ++i)
      for (std::uint32_t k = 0; k < order[h].count; ++k) {
        const float distance = (points[loop[i]] - points[order[h].first + k]).squaredNorm();
        if (distance < best && !blocked(loop[i], order[h].first + k)) best = distance, best_loop = i, best_hole = k;
      }
    std::vector<std::uint32_t> bridged(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best_loop) + 1);
    for (std::uint32_t k = 0; k <= order[h].count; ++k)  // clockwise, and back to where the bridge ends
      bridged.push_back(order[h].first + (best_hole + order[h].count - k) % order[h].count);
    bridged.insert(bridged.end(), loop.begin() + static_cast<std::ptrdiff_t>(best_loop), loop.end());
    loop = std::move(bridged);
  }

  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (loop.size() > 2) {
    const std::size_t n = loop.size();
    std::size_t ear = n;
    float best = 0;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const std::uint32_t a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
      const float area = cross(points[a], points[b], points[c]);
      if (area <= best) continue;
      const bool empty = std::none_of(loop.begin(), loop.end(), [&](std::uint32_t p) {
        return points[p] != points[a] && points[p] != points[b] && points[p] != points[c] &&
               inside(points[p], points[a], points[b], points[c]);
      });
      if (empty) ear = i;
    }
    if (ear == n) {  // rounding left nothing but slivers: any corner will do
      ear = 0;
    } else {
      triangles.push_back({loop[(ear + n - 1) % n], loop[ear], loop[(ear + 1) % n]});
    }
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace svnet::simulation
