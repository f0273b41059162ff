#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "simulation/mesh.h"

namespace svnet::simulation {

struct MeshReading;

/// The colour of surfaces for which a file gives none; linear.
inline const Vec3 kNoColour(0.6f, 0.6f, 0.6f);

/// What a reader of one format fills: a mesh in the file's own unit and place, in double, so that far offsets and small
/// units cost nothing. `name` begins messages.
class MeshDraft {
 public:
  explicit MeshDraft(std::string name) : name_(std::move(name)) {}

  const std::string& name() const { return name_; }

  /// Some may be used by no triangle.
  std::vector<Eigen::Vector3d> points;

  /// Indices of them.
  int add(const Material&);
  /// Throws Error if all images together have more pixels than kMostTexturePixels.
  int add(Image image);
  const Material& material(int index) const { return mesh_.materials[static_cast<std::size_t>(index)]; }

  /// Throws Error for a corner that is no point, and beyond 5 million triangles.
  void add_triangle(const std::array<std::uint32_t, 3>& corner, int material);
  /// Of the triangle added last. Coordinates of textures that are not finite become 0.
  void set_uv(std::array<Vec2, 3> uv);
  void set_metal_uv(std::array<Vec2, 3> uv);
  void set_tints(const std::array<Vec3, 3>& tints);

  /// The mesh in metres, centred if it lies far from its origin, with normals. Throws Error if it has no triangles,
  /// a used point is not finite, or `metres_per_unit` throws for its length in units.
  Mesh finish(const std::function<double(double length)>& metres_per_unit) &&;

 private:
  std::string name_;
  Mesh mesh_;
  Index texture_pixels_ = 0;
};

/// Triangles of a polygon of 3 or more corners, as indices of them: fans if it is convex, else by ear clipping in
/// the plane of its mean normal.
std::vector<std::array<std::uint32_t, 3>> polygon_triangles(std::span<const Eigen::Vector3d> corners);

}  // namespace svnet::simulation
