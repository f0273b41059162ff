#include "simulation/render/object_surfaces.h"

#include <algorithm>

#include "simulation/render/texture_kernels.h"
#include "simulation/texture.h"

namespace svnet::simulation {
namespace {

/// Copies what the kernel needs of each hit, one after another.
void gather_hits(const Mesh& mesh, const Rows3& origin, const Rows3& direction, const Caster::Hits& hits,
                 ObjectSurfaces& object) {
  Corners& corners = object.corners;
  for (std::size_t k = 0; k < object.picked.count; ++k) {
    const std::size_t i = object.picked.at[k];
    const Mesh::Triangle& triangle = mesh.triangles[hits.triangle[i]];
    const auto& normals = mesh.normals[hits.triangle[i]];
    corners.a.set(k, mesh.points[triangle.corner[0]]);
    corners.b.set(k, mesh.points[triangle.corner[1]]);
    corners.c.set(k, mesh.points[triangle.corner[2]]);
    corners.normal_a.set(k, normals[0]);
    corners.normal_b.set(k, normals[1]);
    corners.normal_c.set(k, normals[2]);
    corners.u[k] = hits.u[i], corners.v[k] = hits.v[i];
    object.origin.set(k, origin.get(i));
    object.direction.set(k, direction.get(i));
    object.distance[k] = hits.distance[i];
    object.material[k] = &mesh.materials[static_cast<std::size_t>(triangle.material)];
  }
}

/// The colours of procedural textures, the rays of each material together.
void paint_materials(ObjectSurfaces& object) {
  Picked painted;
  for (std::size_t k = 0; k < object.picked.count; ++k) {
    const Texture texture = object.material[k]->texture;
    if (texture != Texture::plain && texture != Texture::image) painted.add(k);
  }
  std::sort(painted.at, painted.at + painted.count,
            [&](std::uint16_t a, std::uint16_t b) { return object.material[a] < object.material[b]; });
  Rows3 points, colours;
  for (std::size_t first = 0, last = 0; first < painted.count; first = last) {
    const Material* material = object.material[painted.at[first]];
    for (; last < painted.count && object.material[painted.at[last]] == material; ++last)
      points.set(last - first, object.local.get(painted.at[last]));
    paint(*material, last - first, points, colours);
    for (std::size_t k = first; k < last; ++k) object.surfaces.colour.set(painted.at[k], colours.get(k - first));
  }
}

/// What the mesh says between the corners of the triangle that a ray hit.
template <class Value>
Value interpolated(const std::array<Value, 3>& corner, float u, float v) {
  const float w = 1 - u - v;
  return w * corner[0] + u * corner[1] + v * corner[2];
}

}  // namespace

void add_object_surfaces(const Mesh& mesh, const ObjectPlace& place, const Rows3& origin, const Rows3& direction,
                         const Caster::Hits& hits, ObjectSurfaces& object, Surfaces& surfaces) {
  gather_hits(mesh, origin, direction, hits, object);
  finish_object_surfaces(object.picked.count, object.corners, place.to_world_rotation, place.to_local, object.origin,
                         object.direction, object.distance, object.surfaces, object.local);
  paint_materials(object);
  for (std::size_t k = 0; k < object.picked.count; ++k) {
    const std::size_t i = object.picked.at[k];
    const Material& material = *object.material[k];
    const std::uint32_t triangle = hits.triangle[i];
    const float u = hits.u[i], v = hits.v[i];
    Vec3 colour = object.surfaces.colour.get(k);
    if (material.texture == Texture::plain || material.texture == Texture::image) {
      const Vec2 uv = mesh.uv.empty() ? Vec2(0, 0) : interpolated(mesh.uv[triangle], u, v);
      colour = surface_colour(material, object.local.get(k), uv, mesh.images);
    }
    if (!mesh.tints.empty()) colour = colour.cwiseProduct(interpolated(mesh.tints[triangle], u, v));
    object.metal[k] = mesh.metal_uv.empty()
                          ? material.metal
                          : is_metal(material, interpolated(mesh.metal_uv[triangle], u, v), mesh.images);
    surfaces.point.set(i, object.surfaces.point.get(k));
    surfaces.normal.set(i, object.surfaces.normal.get(k));
    surfaces.geometric.set(i, object.surfaces.geometric.get(k));
    surfaces.colour.set(i, colour);
    surfaces.clear[i] = material.clear;
  }
}

}  // namespace svnet::simulation
