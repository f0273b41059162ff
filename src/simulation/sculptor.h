#pragma once
#include <functional>
#include <initializer_list>
#include <vector>

#include "simulation/mesh.h"

namespace svnet::simulation {

using Outline = std::vector<Vec2>;
using Path = std::vector<Vec3>;

/// A shape that a Sculptor has added. Its functions transform it in place, one after the other.
class Part {
 public:
  /// The points of the mesh from `first` on and its triangles from `first_triangle` on.
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
  /// Sets the material of the shapes that follow.
  void use(const Material&);

  /// Joins closed rings in order. Every ring has the same number of points, counter-clockwise as seen from the last
  /// ring. The first and the last ring get a flat cap or, with `loop`, are joined with each other.
  Part loft(const std::vector<Path>& rings, bool loop = false);
  /// Revolves a profile of points (radius, z) about the z axis. An end with a radius above 0 gets a cap.
  Part lathe(const Outline& profile, int segments = 40);
  /// Revolves a closed profile that does not touch the axis: a band, a rim.
  Part hoop(const Outline& profile, int segments = 56);
  /// A round bar along a path. `radii` has one radius for all points or one for each. `flat` scales the cross-section
  /// along its second axis.
  Part tube(const Path& path, const std::vector<float>& radii, bool loop = false, float flat = 1, int segments = 14);
  /// A plate with an outline in the xy plane, centred on z = 0, with bevelled edges. The outline and the holes are
  /// counter-clockwise.
  Part plate(Outline outline, float thickness, float bevel = 0, std::vector<Outline> holes = {});
  /// A body along x that interpolates cross-sections smoothly: blades, bowls of spoons, handles. A cross-section is a
  /// superellipse with the exponent `roundness`, 2 half_width wide along y and `thickness` high, its middle at z =
  /// lift.
  struct Section {
    float x, half_width, thickness, lift = 0, dish = 0;  // dish: how far the middle sinks below the edges
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

/// A smooth curve through points (Catmull-Rom), with `steps` segments between neighbours.
Outline smooth(const Outline& points, int steps = 6, bool loop = false);
Path smooth(const Path& points, int steps = 6, bool loop = false);

/// Outlines, counter-clockwise around the origin.
Outline circle(float radius, int segments = 32);
Outline rounded_rectangle(float x, float y, float radius);
Outline moved(Outline outline, float x, float y);

/// Triangulates an outline with holes, all counter-clockwise, by ear clipping. The result are indices into the points
/// of the outline followed by those of the holes.
std::vector<std::array<std::uint32_t, 3>> triangulated(const Outline& outline, const std::vector<Outline>& holes);

}  // namespace svnet::simulation
