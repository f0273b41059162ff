#include "mesh_check.h"

#include <algorithm>
#include <cmath>

namespace svnet::simulation {
namespace {

bool is_index(int index, std::size_t count) { return index >= 0 && static_cast<std::size_t>(index) < count; }
bool is_index_or_none(int index, std::size_t count) { return index == -1 || is_index(index, count); }

template <class Vector>
bool are_finite(const std::vector<std::array<Vector, 3>>& corners) {
  return std::all_of(corners.begin(), corners.end(), [](const auto& of_triangle) {
    return std::all_of(of_triangle.begin(), of_triangle.end(), [](const Vector& v) { return v.allFinite(); });
  });
}

bool is_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
    case Wrap::mirror:
    case Wrap::clamp:
      return true;
  }
  return false;
}
bool is_texture(Texture texture) {
  switch (texture) {
    case Texture::plain:
    case Texture::wood:
    case Texture::brushed:
    case Texture::speckled:
    case Texture::stripes:
    case Texture::checks:
    case Texture::image:
      return true;
  }
  return false;
}

bool is_consistent_material(const Material& m, std::size_t images) {
  const bool finite = m.colour.allFinite() && m.second.allFinite() && std::isfinite(m.scale_m) &&
                      std::isfinite(m.gloss) && std::isfinite(m.sharpness) && std::isfinite(m.clear) &&
                      std::isfinite(m.metal_factor);
  return finite && is_texture(m.texture) && is_wrap(m.wrap[0]) && is_wrap(m.wrap[1]) &&
         is_index_or_none(m.image, images) && is_index_or_none(m.metal_image, images) &&
         (m.texture != Texture::image || m.image >= 0);
}

bool is_consistent_image(const Image& image) {
  return image.height > 0 && image.width > 0 && image.height <= kMostPixels / image.width &&
         image.rgb.size() == static_cast<std::size_t>(3 * image.height * image.width);
}

}  // namespace

bool is_consistent(const Mesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  const auto is_count_or_empty = [&](std::size_t size) { return size == 0 || size == count; };
  return count > 0 && count <= kMostTriangles && mesh.normals.size() == count && is_count_or_empty(mesh.uv.size()) &&
         is_count_or_empty(mesh.metal_uv.size()) && is_count_or_empty(mesh.tints.size()) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Mesh::Triangle& t) {
                       return is_index(t.material, mesh.materials.size()) &&
                              std::all_of(t.corner.begin(), t.corner.end(),
                                          [&](std::uint32_t corner) { return corner < mesh.points.size(); });
                     }) &&
         std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& point) { return point.allFinite(); }) &&
         are_finite(mesh.normals) && are_finite(mesh.uv) && are_finite(mesh.metal_uv) && are_finite(mesh.tints) &&
         std::all_of(mesh.materials.begin(), mesh.materials.end(),
                     [&](const Material& m) { return is_consistent_material(m, mesh.images.size()); }) &&
         std::all_of(mesh.images.begin(), mesh.images.end(), is_consistent_image);
}

}  // namespace svnet::simulation
