#include "simulation/resting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "simulation/least_rotation.h"

namespace svnet::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Face {
  std::array<std::uint32_t, 3> corner;
  Vector3d normal;
  double offset;
};

Face face_through(std::span<const Vector3d> p, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
  return {{a, b, c}, normal, normal.dot(p[a])};
}

double extent(std::span<const Vector3d> points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box.diagonal().norm();
}

/// Counter-clockwise (Andrew's monotone chain).
std::vector<Vector2d> plane_hull(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= start + 2) {
        const Vector2d u = hull.back() - hull[hull.size() - 2], v = p - hull.back();
        if (u.x() * v.y() - u.y() * v.x() > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// How far the origin lies inside a counter-clockwise polygon; negative outside.
double margin(const std::vector<Vector2d>& polygon) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
    if (edge.norm() > 0) least = std::min(least, (a.x() * edge.y() - a.y() * edge.x()) / edge.norm());
  }
  return polygon.size() < 3 ? -1.0 : least;
}

/// The solid angle of a convex polygon in the plane at distance `height` from the origin (van Oosterom and Strackee
/// 1983).
double solid_angle(const std::vector<Vector2d>& polygon, double height) {
  double sum = 0;
  const auto at = [&](std::size_t i) { return Vector3d(polygon[i].x(), polygon[i].y(), height); };
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vector3d a = at(0), b = at(i), c = at(i + 1);
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    sum += 2 * std::atan2(std::abs(a.dot(b.cross(c))), na * nb * nc + a.dot(b) * nc + a.dot(c) * nb + b.dot(c) * na);
  }
  return sum;
}

/// The points that lie outermost in one of `count` directions, evenly spread (a Fibonacci spiral), in their order.
std::vector<Vector3d> outermost(const std::vector<Vector3d>& points, int count) {
  constexpr std::size_t kBlock = 1024;
  using Floats = Eigen::ArrayXf;
  const auto size = static_cast<Eigen::Index>(points.size());
  Floats x(size), y(size), z(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Vector3d& point = points[static_cast<std::size_t>(i)];
    x[i] = static_cast<float>(point.x()), y[i] = static_cast<float>(point.y()), z[i] = static_cast<float>(point.z());
  }
  std::vector<bool> is_outermost(points.size(), false);
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double height = 1 - (2 * k + 1.0) / count, radius = std::sqrt(1 - height * height);
    const auto dx = static_cast<float>(radius * std::cos(turn * k)),
               dy = static_cast<float>(radius * std::sin(turn * k)), dz = static_cast<float>(height);
    float best = std::numeric_limits<float>::lowest();
    Eigen::Index best_block = 0, best_length = 0;
    for (Eigen::Index i = 0; i < size; i += kBlock) {
      const Eigen::Index length = std::min<Eigen::Index>(kBlock, size - i);
      const float most = (dx * x.segment(i, length) + dy * y.segment(i, length) + dz * z.segment(i, length)).maxCoeff();
      if (most > best) best = most, best_block = i, best_length = length;
    }
    Eigen::Index place = 0;
    (dx * x.segment(best_block, best_length) + dy * y.segment(best_block, best_length) +
     dz * z.segment(best_block, best_length))
        .maxCoeff(&place);
    is_outermost[static_cast<std::size_t>(best_block + place)] = true;
  }
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_outermost[i]) kept.push_back(points[i]);
  return kept;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vector3d> given) {
  // Equal points are merged. Each is moved at random by up to 10⁻⁵ of the extent, well above rounding errors, so that
  // no four points lie in one plane.
  const double size = extent(given);
  check(given.size() >= 4 && size > 0, "[resting] ", given.size(), " points without extent have no convex hull");
  std::map<std::array<std::int64_t, 3>, std::uint32_t> places;
  for (std::uint32_t i = 0; i < given.size(); ++i) {
    const Vector3d scaled = (given[i] - given[0]) / (1e-5 * size);
    places.try_emplace({std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())}, i);
  }
  std::vector<std::uint32_t> number;
  for (const auto& [place, first] : places) number.push_back(first);
  RandomStream random(1, Stream::collection);
  const auto kept = static_cast<Index>(number.size());
  draw_without_replacement(random, number.data(), kept,
                           kept);  // shuffled: sorted points make the most faces on the way
  std::vector<Vector3d> p;
  for (const std::uint32_t i : number) {
    const double z = random.uniform() - 0.5, y = random.uniform() - 0.5, x = random.uniform() - 0.5;
    p.emplace_back(given[i] + 1e-5 * size * Vector3d(x, y, z));
  }

  // The first tetrahedron: the points farthest from a point, a line, a plane.
  const auto farthest = [&](const auto& distance) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < p.size(); ++i)
      if (distance(p[i]) > distance(p[best])) best = i;
    return best;
  };
  const std::uint32_t a = farthest([&](const Vector3d& q) { return -q.x(); });
  const std::uint32_t b = farthest([&](const Vector3d& q) { return (q - p[a]).norm(); });
  const std::uint32_t c = farthest([&](const Vector3d& q) { return (q - p[a]).cross(p[b] - p[a]).norm(); });
  const Face first = face_through(p, a, b, c);
  const std::uint32_t d = farthest([&](const Vector3d& q) { return std::abs(first.normal.dot(q) - first.offset); });
  check(std::abs(first.normal.dot(p[d]) - first.offset) > 1e-4 * size,
        "[resting] all points are in one plane, which is no solid");
  const Vector3d middle = (p[a] + p[b] + p[c] + p[d]) / 4;
  std::vector<Face> faces;
  for (const auto& [i, j, k] : {std::tuple(a, b, c), std::tuple(a, b, d), std::tuple(a, c, d), std::tuple(b, c, d)}) {
    Face face = face_through(p, i, j, k);
    if (face.normal.dot(middle) > face.offset) face = face_through(p, i, k, j);
    faces.push_back(face);
  }
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;  // of the faces that the point sees
    const auto seen = std::partition(faces.begin(), faces.end(), [&](const Face& face) {
      return face.normal.dot(p[i]) <= face.offset + 1e-9 * size;
    });
    if (seen == faces.end()) continue;
    for (auto face = seen; face != faces.end(); ++face)
      for (std::size_t k = 0; k < 3; ++k) edges[{face->corner[k], face->corner[(k + 1) % 3]}] = true;
    faces.erase(seen, faces.end());
    for (const auto& [edge, unused] : edges)
      if (!edges.contains({edge.second, edge.first})) faces.push_back(face_through(p, edge.first, edge.second, i));
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Face& face : faces)
    triangles.push_back({number[face.corner[0]], number[face.corner[1]], number[face.corner[2]]});
  return triangles;
}

std::vector<RestingPose> resting_poses(const Mesh& mesh, std::size_t exact_points) {
  std::vector<Vector3d> points;
  const Vector3d centre = centre_of_mass(mesh);
  for (const Vec3& point : mesh.points) points.emplace_back(point.cast<double>() - centre);
  constexpr int kDirections = 4096;
  if (points.size() > exact_points) points = outermost(points, kDirections);
  const double size = extent(points);
  const auto hull = convex_hull(points);
  std::vector<Vector3d> corners;  // of the hull, relative to the centre of mass
  struct Candidate {
    Vector3d normal;
    double area;
  };
  std::vector<Candidate> candidates;
  for (const auto& [a, b, c] : hull) {
    corners.insert(corners.end(), {points[a], points[b], points[c]});
    const Vector3d normal = (points[b] - points[a]).cross(points[c] - points[a]);
    if (normal.norm() > 1e-6 * size * size) candidates.push_back({normal.normalized(), normal.norm()});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.area > b.area; });

  const double least_tilt = 2.5 * std::numbers::pi / 180;
  std::vector<Vector3d> done;                         // normals of stable faces; those within 3° are the same face
  std::vector<std::pair<RestingPose, double>> found;  // with the tilt that it withstands, in radians
  for (const Candidate& candidate : candidates) {
    const Vector3d down = candidate.normal;
    if (std::any_of(done.begin(), done.end(), [&](const Vector3d& other) { return other.dot(down) > 0.9986; }))
      continue;
    const Eigen::Quaterniond rotation = least_rotation<double>(down, -Vector3d::UnitZ());
    double height = 0;
    for (const Vector3d& corner : corners) height = std::max(height, corner.dot(down));
    std::vector<Vector2d> support;
    for (const Vector3d& corner : corners)
      if (corner.dot(down) > height - 0.003 * size) support.emplace_back((rotation * corner).head<2>());
    const std::vector<Vector2d> polygon = plane_hull(support);
    const double tilt = std::atan2(margin(polygon), height);
    if (tilt < least_tilt && !found.empty() && found.front().second >= tilt) continue;
    if (tilt >= least_tilt) done.push_back(down);
    found.push_back({{rotation, height, solid_angle(polygon, height) / (4 * std::numbers::pi)}, tilt});
  }
  check(!found.empty(), "[resting] the solid has no face to lie on");
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  const auto falls =
      std::find_if(found.begin() + 1, found.end(), [&](const auto& pose) { return pose.second < least_tilt; });
  found.erase(falls, found.end());

  // Kinds by height, each with its faces by share.
  struct Kind {
    std::vector<RestingPose> faces;
    double share = 0;
  };
  std::vector<Kind> kinds;
  for (const auto& [pose, tilt] : found) {
    const auto alike = std::find_if(kinds.begin(), kinds.end(), [&, &face = pose](const Kind& kind) {
      return std::abs(kind.faces.front().centre_height_m - face.centre_height_m) < 0.01 * size;
    });
    Kind& kind = alike != kinds.end() ? *alike : kinds.emplace_back();
    kind.faces.push_back(pose);
    kind.share += pose.share;
  }
  std::stable_sort(kinds.begin(), kinds.end(), [](const Kind& a, const Kind& b) { return a.share > b.share; });
  const auto rare = std::find_if(kinds.begin() + 1, kinds.end(), [](const Kind& kind) { return kind.share < 0.08; });
  kinds.erase(rare, kinds.end());
  std::vector<RestingPose> poses;
  for (std::size_t rank = 0, added = 1; added > 0; ++rank) {
    added = 0;
    for (Kind& kind : kinds) {
      if (rank == 0)
        std::stable_sort(kind.faces.begin(), kind.faces.end(),
                         [](const RestingPose& a, const RestingPose& b) { return a.share > b.share; });
      if (rank < kind.faces.size()) poses.push_back(kind.faces[rank]), ++added;
    }
  }
  return poses;
}

}  // namespace svnet::simulation
