#pragma once
#include <functional>
#include <initializer_list>
#include <vector>

#include "simulation/mesh.h"

namespace svnet {

using Outline = std::vector<Vec2>;
using Path = std::vector<Vec3>;

/// The shape that a Sculptor just added, to be moved where it belongs. Each change applies to the points as they are.
class Part {
 public:
  /// The points from `first`, the triangles from `first_triangle`, to the last ones of the mesh.
  Part(Mesh& mesh, std::size_t first, std::size_t first_triangle)
      : mesh_(&mesh),
        first_(first),
        end_(mesh.points.size()),
        first_triangle_(first_triangle),
        end_triangle_(mesh.triangles.size()) {}

  Part& move(float x, float y, float z);
  Part& turn_x(float degrees) { return turn(Vec3::UnitX(), degrees); }
  Part& turn_y(float degrees) { return turn(Vec3::UnitY(), degrees); }
  Part& turn_z(float degrees) { return turn(Vec3::UnitZ(), degrees); }
  Part& scale(float x, float y, float z);  // negative factors mirror
  Part& bend(const std::function<Vec3(Vec3)>&);

 private:
  Part& turn(const Vec3& axis, float degrees);

  Mesh* mesh_;
  std::size_t first_, end_, first_triangle_, end_triangle_;
};

/// Builds a mesh from closed shapes that may overlap: lathes, sweeps, extrusions and a few primitives. Lengths are in
/// millimetres until take(). Shapes are made around the origin and take the material in use.
class Sculptor {
 public:
  /// From now on shapes are made of this.
  void use(const Material&);

  /// Closed rings of as many points each, joined in order; the first and the last are closed with a flat cap, or joined
  /// with one another where `loop`. Rings run counter-clockwise when seen from the last one.
  Part loft(const std::vector<Path>& rings, bool loop = false);
  /// (radius, z) from one end to the other, turned about z; with an end's radius above 0 that end is capped.
  Part lathe(const Outline& profile, int segments = 40);
  /// The same for a profile that closes on itself without touching the axis: a band, a rim.
  Part hoop(const Outline& profile, int segments = 56);
  /// A round bar along a path; `radii` one for all points, or one each. `flat` squeezes it along its own second axis.
  Part tube(const Path& path, const std::vector<float>& radii, bool loop = false, float flat = 1, int segments = 14);
  /// A plate with this outline (counter-clockwise) in xy, centred on z = 0, its edges broken by `bevel`; holes are
  /// given counter-clockwise too.
  Part plate(Outline outline, float thickness, float bevel = 0, std::vector<Outline> holes = {});
  /// A body along x whose cross-section at `x` is 2 half_width(u) wide along y and thickness(u) high, u in [0, 1] from
  /// the first to the last: top surface at lift(u, v) above z = 0 for v in [-1, 1] across. Blades, bowls of spoons,
  /// handles.
  struct Section {
    float x, half_width, thickness, lift = 0, dish = 0;  // dish: how much lower the middle lies than the edges
  };
  Part strip(const std::vector<Section>& sections, int subdivisions = 5, float roundness = 2);
  Part box(float x, float y, float z, float bevel = 1);
  Part ball(float x, float y, float z);  // radii
  Part cylinder(float radius, float height, float bevel = 0.5f);
  Part torus(float radius, float thickness);

  /// The mesh in metres, with normals.
  Mesh take();

 private:
  void triangle(std::size_t a, std::size_t b, std::size_t c);
  void cap(const Path& ring, bool reversed);

  Mesh mesh_;
};

/// A smooth curve through points (Catmull-Rom), `steps` pieces between neighbours.
Outline smooth(const Outline& points, int steps = 6, bool loop = false);
Path smooth(const Path& points, int steps = 6, bool loop = false);

/// Outlines, counter-clockwise around the origin.
Outline circle(float radius, int segments = 32);
Outline rounded_rectangle(float x, float y, float radius);
Outline moved(Outline outline, float x, float y);

/// Triangles over an outline with holes, all counter-clockwise, by ear clipping; numbers of points in the outline
/// followed by those of the holes in order.
std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline, const std::vector<Outline>& holes);

}  // namespace svnet
