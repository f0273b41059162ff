#include "simulation/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace svnet::simulation {
namespace {

/// An index per point; points that agree to a micrometre have the same index.
std::vector<std::uint32_t> places(const std::vector<Vec3>& points) {
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::uint32_t>;
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto rounded = [](float x) { return static_cast<std::int64_t>(std::lround(static_cast<double>(x) * 1e6)); };
    keys.emplace_back(rounded(points[i].x()), rounded(points[i].y()), rounded(points[i].z()),
                      static_cast<std::uint32_t>(i));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> place(points.size());
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto [x, y, z, i] = keys[k];
    if (k > 0 &&
        std::tie(x, y, z) != std::tie(std::get<0>(keys[k - 1]), std::get<1>(keys[k - 1]), std::get<2>(keys[k - 1])))
      ++count;
    place[i] = count;
  }
  return place;
}

}  // namespace

void shade_smoothly(Mesh& mesh, float crease_deg) {
  const std::size_t count = mesh.triangles.size();
  const std::vector<std::uint32_t> place = places(mesh.points);
  std::vector<Vec3> weighted(count), unit(count);
  std::vector<std::vector<std::uint32_t>> around(mesh.points.size());
  for (std::size_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = mesh.triangles[t].corner;
    weighted[t] = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const float length = weighted[t].norm();
    unit[t] = length > 0 ? Vec3(weighted[t] / length) : Vec3::UnitZ();
    for (const std::uint32_t corner : mesh.triangles[t].corner)
      around[place[corner]].push_back(static_cast<std::uint32_t>(t));
  }
  const float crease = std::cos(crease_deg * std::numbers::pi_v<float> / 180);
  mesh.normals.assign(count, {});
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = Vec3::Zero();
      for (const std::uint32_t other : around[place[mesh.triangles[t].corner[k]]])
        if (unit[other].dot(unit[t]) >= crease) sum += weighted[other];
      mesh.normals[t][k] = sum.squaredNorm() > 0 ? Vec3(sum.normalized()) : unit[t];
    }
}

Eigen::Vector3d centre_of_mass(const Mesh& mesh) {
  using Eigen::Vector3d;
  Vector3d by_volume = Vector3d::Zero(), by_area = Vector3d::Zero();
  double volume = 0, area = 0, size = 0;
  const Vector3d origin = mesh.points.front().cast<double>();
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    Vector3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh.points[triangle.corner[k]].cast<double>() - origin;
    const double v = p[0].dot(p[1].cross(p[2])) / 6, a = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    volume += v;
    by_volume += v / 4 * (p[0] + p[1] + p[2]);
    area += a;
    by_area += a / 3 * (p[0] + p[1] + p[2]);
    size = std::max({size, p[0].norm(), p[1].norm(), p[2].norm()});
  }
  // Without volume (a sheet), or if the centre would lie outside an open mesh, the surface decides. The volume is
  // negative if the triangles face inwards.
  if (std::abs(volume) > 1e-4 * area * size) {
    const Vector3d centre = by_volume / volume;
    if (centre.norm() <= size) return origin + centre;
  }
  return area > 0 ? Vector3d(origin + by_area / area) : origin;
}

}  // namespace svnet::simulation
