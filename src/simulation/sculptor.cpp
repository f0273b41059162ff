#include "simulation/sculptor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/least_rotation.h"

namespace svnet::simulation {
namespace {

/// The outline moved inwards by `distance` along its normals.
Outline inset(const Outline& outline, float distance) {
  const std::size_t n = outline.size();
  Outline result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = (outline[i] - outline[(i + n - 1) % n]).normalized(),
               after = (outline[(i + 1) % n] - outline[i]).normalized();
    const Vec2 left_before(-before.y(), before.x()), left_after(-after.y(), after.x());
    const Vec2 sum = left_before + left_after;
    result[i] = outline[i] + sum * (distance / std::max(0.5f, 1 + left_before.dot(left_after)));
  }
  return result;
}

Path raised(const Outline& outline, float z) {
  Path ring;
  for (const Vec2& point : outline) ring.emplace_back(point.x(), point.y(), z);
  return ring;
}

}  // namespace

Part& Part::bend(const std::function<Vec3(Vec3)>& change) {
  for (std::size_t i = first_; i < end_; ++i) mesh_->points[i] = change(mesh_->points[i]);
  return *this;
}

Part& Part::move(float x, float y, float z) {
  return bend([&](const Vec3& p) { return Vec3(p + Vec3(x, y, z)); });
}

Part& Part::scale(float x, float y, float z) {
  if (x * y * z < 0)  // keep the outside outside
    for (std::size_t t = first_triangle_; t < end_triangle_; ++t)
      std::swap(mesh_->triangles[t].corner[1], mesh_->triangles[t].corner[2]);
  return bend([&](const Vec3& p) { return Vec3(p.cwiseProduct(Vec3(x, y, z))); });
}

Part& Part::turn(const Vec3& axis, float degrees) {
  const Eigen::Matrix3f rotation =
      Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis).toRotationMatrix();
  return bend([&](const Vec3& p) { return Vec3(rotation * p); });
}

void Sculptor::use(const Material& material) { mesh_.materials.push_back(material); }

void Sculptor::triangle(std::size_t a, std::size_t b, std::size_t c) {
  const auto& p = mesh_.points;
  if ((p[b] - p[a]).cross(p[c] - p[a]).norm() < 1e-6f) return;
  mesh_.triangles.push_back(
      {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)},
       static_cast<int>(mesh_.materials.size()) - 1});
}

void Sculptor::cap(const Path& ring, bool reversed) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& point : ring) centre += point / static_cast<float>(ring.size());
  const std::size_t base = mesh_.points.size();
  mesh_.points.push_back(centre);
  mesh_.points.insert(mesh_.points.end(), ring.begin(), ring.end());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t a = base + 1 + i, b = base + 1 + (i + 1) % ring.size();
    reversed ? triangle(base, b, a) : triangle(base, a, b);
  }
}

Part Sculptor::loft(const std::vector<Path>& rings, bool loop) {
  const std::size_t first = mesh_.points.size(), first_triangle = mesh_.triangles.size(), n = rings.front().size(),
                    count = rings.size();
  for (const Path& ring : rings) mesh_.points.insert(mesh_.points.end(), ring.begin(), ring.end());
  for (std::size_t r = 0; r < (loop ? count : count - 1); ++r)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t a = first + r * n + i, b = first + r * n + (i + 1) % n;
      const std::size_t c = first + (r + 1) % count * n + (i + 1) % n, d = first + (r + 1) % count * n + i;
      triangle(a, b, c);
      triangle(a, c, d);
    }
  if (!loop) {
    cap(rings.front(), true);
    cap(rings.back(), false);
  }
  return Part(mesh_, first, first_triangle);
}

Part Sculptor::lathe(const Outline& profile, int segments) {
  std::vector<Path> rings;
  for (const Vec2& point : profile) rings.push_back(raised(circle(point.x(), segments), point.y()));
  return loft(rings);
}

Part Sculptor::hoop(const Outline& profile, int segments) {
  std::vector<Path> rings;
  for (const Vec2& point : profile) rings.push_back(raised(circle(point.x(), segments), point.y()));
  return loft(rings, true);
}

Part Sculptor::tube(const Path& path, const std::vector<float>& radii, bool loop, float flat, int segments) {
  // Frames carried along the path with the least turning; on a loop the turn that is left at its end is spread over it.
  const std::size_t n = path.size();
  std::vector<Vec3> along(n), side(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : (loop ? n - 1 : 0), after = i + 1 < n ? i + 1 : (loop ? 0 : n - 1);
    along[i] = (path[after] - path[before]).normalized();
  }
  side[0] = (std::abs(along[0].z()) < 0.9f ? Vec3::UnitZ() : Vec3::UnitX()).cross(along[0]).normalized();
  for (std::size_t i = 1; i < n; ++i) side[i] = (least_rotation(along[i - 1], along[i]) * side[i - 1]).normalized();
  float twist = 0;
  if (loop) {
    const Vec3 end = least_rotation(along[n - 1], along[0]) * side[n - 1];
    twist = std::atan2(end.cross(side[0]).dot(along[0]), end.dot(side[0]));
  }
  std::vector<Path> rings;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 u = Eigen::AngleAxisf(twist * static_cast<float>(i) / static_cast<float>(n), along[i]) * side[i];
    const Vec3 v = along[i].cross(u);
    const float radius = radii[std::min(i, radii.size() - 1)];
    Path ring;
    for (const Vec2& point : circle(radius, segments)) ring.push_back(path[i] + point.x() * u + point.y() * flat * v);
    rings.push_back(std::move(ring));
  }
  return loft(rings, loop);
}

Part Sculptor::plate(Outline outline, float thickness, float bevel, std::vector<Outline> holes) {
  const std::size_t first = mesh_.points.size(), first_triangle = mesh_.triangles.size();
  const float half = thickness / 2;
  for (Outline& hole : holes) std::reverse(hole.begin(), hole.end());
  std::vector<const Outline*> contours{&outline};
  for (const Outline& hole : holes) contours.push_back(&hole);
  Outline face;  // the points of all contours at the top
  Outline face_outline;
  std::vector<Outline> face_holes;
  for (const Outline* contour : contours) {
    const Outline inner = bevel > 0 ? inset(*contour, bevel) : *contour;
    std::vector<Path> rings{raised(inner, -half), raised(*contour, -half + bevel), raised(*contour, half - bevel),
                            raised(inner, half)};
    if (bevel <= 0) rings = {raised(inner, -half), raised(inner, half)};
    const std::size_t base = mesh_.points.size(), n = inner.size();
    for (const Path& ring : rings) mesh_.points.insert(mesh_.points.end(), ring.begin(), ring.end());
    for (std::size_t r = 0; r + 1 < rings.size(); ++r)
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t a = base + r * n + i, b = base + r * n + (i + 1) % n;
        triangle(a, b, b + n);
        triangle(a, b + n, a + n);
      }
    if (contour == &outline) {
      face_outline = inner;
      face = inner;
    } else {
      Outline forward(inner.rbegin(), inner.rend());
      face.insert(face.end(), forward.begin(), forward.end());
      face_holes.push_back(std::move(forward));
    }
  }
  const auto triangles = triangulated(face_outline, face_holes);
  for (const float z : {-half, half}) {
    const std::size_t base = mesh_.points.size();
    const Path ring = raised(face, z);
    mesh_.points.insert(mesh_.points.end(), ring.begin(), ring.end());
    for (const auto& [a, b, c] : triangles)
      z > 0 ? triangle(base + a, base + b, base + c) : triangle(base + a, base + c, base + b);
  }
  return Part(mesh_, first, first_triangle);
}

Part Sculptor::strip(const std::vector<Section>& sections, int subdivisions, float roundness) {
  // Each quantity is a smooth curve over the sections.
  std::vector<Path> rings;
  Path a, b;
  for (const Section& s : sections) {
    a.emplace_back(s.x, s.half_width, s.thickness);
    b.emplace_back(s.lift, s.dish, 0);
  }
  a = smooth(a, subdivisions);
  b = smooth(b, subdivisions);
  constexpr int kAcross = 28;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float half_width = std::max(a[i].y(), 0.01f), thickness = std::max(a[i].z(), 0.01f);
    Path ring;
    for (int k = 0; k < kAcross; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kAcross;
      const float c = std::cos(angle), s = std::sin(angle);
      // A superellipse: 2 is an ellipse, more is squarer.
      const float v = std::copysign(std::pow(std::abs(c), 2 / roundness), c),
                  w = std::copysign(std::pow(std::abs(s), 2 / roundness), s);
      ring.emplace_back(a[i].x(), half_width * v, b[i].x() + thickness / 2 * w - b[i].y() * (1 - v * v));
    }
    rings.push_back(std::move(ring));
  }
  return loft(rings);
}

Part Sculptor::box(float x, float y, float z, float bevel) {
  return plate(rounded_rectangle(x, y, std::max(bevel, 0.01f)), z, bevel);
}

Part Sculptor::ball(float x, float y, float z) {
  Outline profile;
  for (int i = 0; i <= 20; ++i)
    profile.emplace_back(std::sin(std::numbers::pi_v<float> * static_cast<float>(i) / 20),
                         -std::cos(std::numbers::pi_v<float> * static_cast<float>(i) / 20));
  return lathe(profile, 32).scale(x, y, z);
}

Part Sculptor::cylinder(float radius, float height, float bevel) {
  return lathe({{radius - bevel, -height / 2},
                {radius, -height / 2 + bevel},
                {radius, height / 2 - bevel},
                {radius - bevel, height / 2}});
}

Part Sculptor::torus(float radius, float thickness) { return tube(raised(circle(radius, 48), 0), {thickness}, true); }

Mesh Sculptor::take() {
  for (Vec3& point : mesh_.points) point *= 0.001f;
  shade_smoothly(mesh_);
  return std::move(mesh_);
}

}  // namespace svnet::simulation
