#include "mesh_draft.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "mesh_check.h"
#include "simulation/least_rotation.h"
#include "simulation/sculptor.h"

namespace svnet::simulation {
namespace {

using Eigen::Vector3d;

/// Coordinates beyond this say nothing about an image.
bool is_place(const Vec2& uv) { return uv.allFinite() && uv.cwiseAbs().maxCoeff() < 1e6f; }

void set_last(std::vector<std::array<Vec2, 3>>& all, std::size_t count, std::array<Vec2, 3> uv) {
  for (Vec2& place : uv)
    if (!is_place(place)) place.setZero();
  all.resize(count - 1, {Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)});
  all.push_back(uv);
}

/// Keeps the points that triangles use, in their order.
std::vector<Vector3d> take_used(const std::vector<Vector3d>& points, std::vector<Mesh::Triangle>& triangles) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(points.size(), kUnused);
  for (const Mesh::Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle.corner) place[corner] = 0;
  std::vector<Vector3d> used;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (place[i] != kUnused) place[i] = static_cast<std::uint32_t>(used.size()), used.push_back(points[i]);
  for (Mesh::Triangle& triangle : triangles)
    for (std::uint32_t& corner : triangle.corner) corner = place[corner];
  return used;
}

}  // namespace

int MeshDraft::add(const Material& material) {
  mesh_.materials.push_back(material);
  return static_cast<int>(mesh_.materials.size()) - 1;
}

int MeshDraft::add(Image image) {
  texture_pixels_ += image.height * image.width;
  check(texture_pixels_ <= kMostTexturePixels, name_, ": its textures have more than ", kMostTexturePixels / 1'000'000,
        " megapixels; make them smaller");
  mesh_.images.push_back(std::move(image));
  return static_cast<int>(mesh_.images.size()) - 1;
}

void MeshDraft::add_triangle(const std::array<std::uint32_t, 3>& corner, int material) {
  for (const std::uint32_t c : corner)
    check(c < points.size(), name_, ": triangle ", mesh_.triangles.size(), " has a corner at point ", c, " of ",
          points.size());
  check(mesh_.triangles.size() < kMostTriangles, name_, ": has more than ", kMostTriangles,
        " triangles; make it simpler");
  mesh_.triangles.push_back({corner, material});
}

void MeshDraft::set_uv(std::array<Vec2, 3> uv) { set_last(mesh_.uv, mesh_.triangles.size(), uv); }
void MeshDraft::set_metal_uv(std::array<Vec2, 3> uv) { set_last(mesh_.metal_uv, mesh_.triangles.size(), uv); }

void MeshDraft::set_tints(const std::array<Vec3, 3>& tints) {
  mesh_.tints.resize(mesh_.triangles.size() - 1, {Vec3::Ones(), Vec3::Ones(), Vec3::Ones()});
  mesh_.tints.push_back(tints);
}

Mesh MeshDraft::finish(const std::function<double(double length)>& metres_per_unit) && {
  constexpr double kFar = 16;  // lengths of the object, beyond which float coordinates would lose detail
  check(!mesh_.triangles.empty(), name_, ": holds no triangles");
  const std::vector<Vector3d> used = take_used(points, mesh_.triangles);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    check(used[i].allFinite(), name_, ": a corner of a triangle, (", used[i].x(), ", ", used[i].y(), ", ", used[i].z(),
          "), is not finite");
    box.extend(used[i]);
  }
  const double length = box.sizes().maxCoeff(), unit = metres_per_unit(length);
  const Vector3d origin = box.center().norm() > kFar * length ? Vector3d(box.center()) : Vector3d::Zero();
  mesh_.points.reserve(used.size());
  for (const Vector3d& point : used) mesh_.points.emplace_back(((point - origin) * unit).cast<float>());
  const std::size_t count = mesh_.triangles.size();
  if (!mesh_.uv.empty()) mesh_.uv.resize(count, {Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)});
  if (!mesh_.metal_uv.empty()) mesh_.metal_uv.resize(count, {Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)});
  if (!mesh_.tints.empty()) mesh_.tints.resize(count, {Vec3::Ones(), Vec3::Ones(), Vec3::Ones()});
  shade_smoothly(mesh_);
  return std::move(mesh_);
}

std::vector<std::array<std::uint32_t, 3>> polygon_triangles(std::span<const Vector3d> corners) {
  constexpr std::size_t kMostEars = 1024;  // ear clipping takes at least the square of the corners
  const std::size_t count = corners.size();
  Vector3d normal = Vector3d::Zero();  // Newell's
  for (std::size_t i = 0; i < count; ++i)
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % count] - corners[0]);
  const auto is_convex_at = [&](std::size_t i) {
    const Vector3d before = corners[i] - corners[(i + count - 1) % count],
                   after = corners[(i + 1) % count] - corners[i];
    return before.cross(after).dot(normal) >= 0;
  };
  std::size_t concave = count;
  for (std::size_t i = 0; i < count && count > 3; ++i)
    if (!is_convex_at(i)) concave = i;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (concave == count || count == 4 || count > kMostEars) {
    // A quadrangle's diagonal begins at its concave corner.
    const std::size_t first = concave == count || count > kMostEars ? 0 : concave;
    const auto at = [&](std::size_t i) { return static_cast<std::uint32_t>((first + i) % count); };
    for (std::size_t i = 1; i + 1 < count; ++i) triangles.push_back({at(0), at(i), at(i + 1)});
    return triangles;
  }
  const Eigen::Quaterniond upright = least_rotation<double>(normal, Vector3d::UnitZ());
  Eigen::AlignedBox3d box;
  for (const Vector3d& corner : corners) box.extend(corner);
  Outline outline;
  for (const Vector3d& corner : corners)
    outline.emplace_back((upright * ((corner - corners[0]) / box.sizes().maxCoeff())).head<2>().cast<float>());
  return triangulated(outline, {});
}

}  // namespace svnet::simulation
