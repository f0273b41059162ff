#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "gltf_file.h"
#include "gltf_materials.h"
#include "mesh_readers.h"

namespace svnet::simulation {
namespace {

using Json = GltfFile::Json;

constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;  // modes of primitives; the others are points and lines

class GltfReader {
 public:
  GltfReader(const GltfFile& file, MeshDraft& draft) : file_(file), materials_(file, draft), draft_(draft) {}

  void read() {
    for (const std::size_t node : root_nodes()) read_node(node, Eigen::Affine3d::Identity(), 0);
  }

 private:
  /// Of the default scene, or the first one; without scenes all nodes that are nobody's children.
  std::vector<std::size_t> root_nodes() const {
    const auto scenes = file_.root().find("scenes");
    if (scenes != file_.root().end() && scenes->is_array() && !scenes->empty())
      return children(file_.item("scenes", file_.index(file_.root(), "scene").value_or(0)), "nodes");
    std::set<std::size_t> found;
    const auto nodes = file_.root().find("nodes");
    const std::size_t count = nodes != file_.root().end() && nodes->is_array() ? nodes->size() : 0;
    for (std::size_t i = 0; i < count; ++i) found.insert(i);
    for (std::size_t i = 0; i < count; ++i)
      for (const std::size_t child : children(file_.item("nodes", i), "children")) found.erase(child);
    return {found.begin(), found.end()};
  }

  std::vector<std::size_t> children(const Json& parent, const char* member) const {
    const auto list = parent.find(member);
    std::vector<std::size_t> result;
    if (list == parent.end()) return result;
    check(list->is_array(), draft_.name(), ": '", member, "' is not a list");
    for (const Json& child : *list) {
      check(child.is_number_unsigned(), draft_.name(), ": '", member, "' holds what is not the number of a node");
      result.push_back(child.get<std::size_t>());
    }
    return result;
  }

  Eigen::Affine3d transform(const Json& node) const {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      const auto matrix = file_.numbers(node, "matrix", std::vector<double>(16));
      result.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
      return result;
    }
    const auto move = file_.numbers(node, "translation", {0.0, 0.0, 0.0}),
               turn = file_.numbers(node, "rotation", {0.0, 0.0, 0.0, 1.0}),
               scale = file_.numbers(node, "scale", {1.0, 1.0, 1.0});
    return result.translate(Eigen::Vector3d(move[0], move[1], move[2]))
        .rotate(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]).normalized())
        .scale(Eigen::Vector3d(scale[0], scale[1], scale[2]));
  }

  void read_node(std::size_t number, const Eigen::Affine3d& parent, int depth) {
    constexpr int kDeepest = 256;
    check(depth < kDeepest && nodes_.insert(number).second, draft_.name(), ": its nodes are no tree: node ", number,
          " has more than one parent");
    const Json& node = file_.item("nodes", number);
    const Eigen::Affine3d placed = parent * transform(node);
    if (const auto mesh = file_.index(node, "mesh")) {
      const Json& primitives = file_.item("meshes", *mesh);
      const auto list = primitives.find("primitives");
      check(list != primitives.end() && list->is_array(), draft_.name(), ": meshes[", *mesh, "] has no primitives");
      for (const Json& primitive : *list) {
        check(primitive.is_object(), draft_.name(), ": meshes[", *mesh, "] has a primitive that is not an object");
        read_primitive(primitive, placed);
      }
    }
    for (const std::size_t child : children(node, "children")) read_node(child, placed, depth + 1);
  }

  /// Of a primitive, `width` numbers per point, or none.
  std::optional<GltfFile::Numbers> attribute(const Json& primitive, const std::string& name, std::size_t least_width,
                                             std::size_t points, bool normalise = false) const {
    const auto accessor = file_.index(file_.object(primitive, "attributes"), name.c_str());
    if (!accessor) return std::nullopt;
    auto numbers = file_.accessor(*accessor, normalise);
    check(numbers.width >= least_width && (points == 0 || numbers.count() == points), draft_.name(), ": ", name,
          " has ", numbers.count(), " elements of ", numbers.width, " numbers, expected ", points, " of ", least_width);
    return numbers;
  }

  /// The texture's coordinates per point: v points down in glTF, and up in a Mesh.
  std::vector<Vec2> places(const Json& primitive, const std::optional<TextureCoordinates>& from, std::size_t points) {
    std::vector<Vec2> result;
    if (!from) return result;
    const std::string name = "TEXCOORD_" + std::to_string(from->set);
    const auto numbers = attribute(primitive, name, 2, points);
    if (!numbers) {
      if (warned_.insert(name).second)
        file_.files().warn("a textured part has no " + name + "; it is rendered without the texture");
      return result;
    }
    result.reserve(points);
    for (std::size_t i = 0; i < points; ++i) {
      const Eigen::Vector2d place =
          from->turn * Eigen::Vector2d(numbers->values[numbers->width * i], numbers->values[numbers->width * i + 1]) +
          from->offset;
      result.emplace_back(static_cast<float>(place.x()), static_cast<float>(1 - place.y()));
    }
    return result;
  }

  /// Whether the primitive has no uncompressed form beside the one of Draco.
  bool is_only_compressed(const Json& primitive) const {
    if (!file_.object(primitive, "extensions").contains("KHR_draco_mesh_compression")) return false;
    const auto positions = file_.index(file_.object(primitive, "attributes"), "POSITION");
    return !positions || !file_.index(file_.item("accessors", *positions), "bufferView");
  }

  void read_primitive(const Json& primitive, const Eigen::Affine3d& placed) {
    const std::size_t mode = file_.index(primitive, "mode").value_or(kTriangles);
    if (mode < kTriangles || mode > kFan) return;
    check(!is_only_compressed(primitive), draft_.name(),
          ": is compressed by KHR_draco_mesh_compression, which is not read; save it without Draco compression");
    const auto positions = attribute(primitive, "POSITION", 3, 0);
    if (!positions) return;
    const std::size_t count = positions->count();
    const GltfMaterial& material = materials_.of_primitive(primitive);
    const std::vector<Vec2> uv = places(primitive, material.image, count),
                            metal_uv = places(primitive, material.metal_image, count);
    // COLOR_0 is linear (3.7.2.1).
    const auto colours = attribute(primitive, "COLOR_0", 3, count, true);
    const bool lost_image = material.image && uv.empty();
    const int number = lost_image ? without_image(material.index) : material.index;

    const auto base = static_cast<std::uint32_t>(draft_.points.size());
    check(draft_.points.size() + count < 0xffffffff, draft_.name(), ": has too many points");
    for (std::size_t i = 0; i < count; ++i)
      draft_.points.push_back(placed * Eigen::Vector3d(positions->values[3 * i], positions->values[3 * i + 1],
                                                       positions->values[3 * i + 2]));
    std::vector<std::size_t> corners;
    if (const auto indices = file_.index(primitive, "indices")) {
      for (const double corner : file_.accessor(*indices).values) {
        check(corner >= 0 && corner < static_cast<double>(count), draft_.name(), ": a triangle has a corner at point ",
              corner, " of ", count);
        corners.push_back(static_cast<std::size_t>(corner));
      }
    } else {
      for (std::size_t i = 0; i < count; ++i) corners.push_back(i);
    }
    const bool is_mirrored = placed.linear().determinant() < 0;
    const std::size_t triangles =
        mode == kTriangles ? corners.size() / 3 : std::max<std::size_t>(corners.size(), 2) - 2;
    for (std::size_t t = 0; t < triangles; ++t) {
      const std::size_t at = mode == kTriangles ? 3 * t : t;
      std::array<std::size_t, 3> triangle{mode == kFan ? corners[0] : corners[at], corners[at + 1], corners[at + 2]};
      if ((mode == kStrip && t % 2 == 1) != is_mirrored) std::swap(triangle[1], triangle[2]);
      std::array<std::uint32_t, 3> placed_corner{};
      std::array<Vec2, 3> at_image, at_metal;
      std::array<Vec3, 3> tints;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = triangle[k];
        placed_corner[k] = base + static_cast<std::uint32_t>(i);
        if (!uv.empty()) at_image[k] = uv[i];
        if (!metal_uv.empty()) at_metal[k] = metal_uv[i];
        if (colours)
          for (std::size_t c = 0; c < 3; ++c) {
            const double value = colours->values[colours->width * i + c];
            tints[k][static_cast<Eigen::Index>(c)] = value > 0 ? static_cast<float>(std::min(value, 1.0)) : 0.0f;
          }
      }
      draft_.add_triangle(placed_corner, number);
      if (!uv.empty()) draft_.set_uv(at_image);
      if (!metal_uv.empty()) draft_.set_metal_uv(at_metal);
      if (colours) draft_.set_tints(tints);
    }
  }

  int without_image(int index) {
    Material material = draft_.material(index);
    material.texture = Texture::plain;
    material.image = -1;
    return draft_.add(material);
  }

  const GltfFile& file_;
  GltfMaterials materials_;
  MeshDraft& draft_;
  std::set<std::size_t> nodes_;
  std::set<std::string> warned_;
};

}  // namespace

void read_gltf(std::string_view file, const MeshFiles& files, MeshDraft& draft) {
  const GltfFile gltf(file, files);
  GltfReader(gltf, draft).read();
}

}  // namespace svnet::simulation
