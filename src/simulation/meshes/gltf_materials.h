#pragma once
#include <map>
#include <optional>

#include "gltf_file.h"
#include "mesh_textures.h"

namespace svnet::simulation {

/// From which coordinates a texture is read, and how they are moved (KHR_texture_transform).
struct TextureCoordinates {
  std::size_t set = 0;
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

/// A material of the draft, and the coordinates of its textures, if it has them.
struct GltfMaterial {
  int index = -1;
  std::optional<TextureCoordinates> image, metal_image;
};

/// The materials of a glTF file, each read at its first use. The base colour is factor × texture (3.9.2), metalness
/// factor × blue channel of the texture; KHR_materials_unlit and specular-glossiness are no metal.
class GltfMaterials {
 public:
  GltfMaterials(const GltfFile& file, MeshDraft& draft) : file_(file), textures_(file.files(), draft), draft_(draft) {}

  /// Of a primitive; the standard's default material if it names none.
  const GltfMaterial& of_primitive(const GltfFile::Json& primitive);

 private:
  GltfMaterial read(const GltfFile::Json& from);
  std::optional<int> texture(const GltfFile::Json& from);
  std::optional<int> image(std::size_t index);
  std::array<Wrap, 2> wrap(const GltfFile::Json& texture) const;
  TextureCoordinates coordinates(const GltfFile::Json& info) const;

  const GltfFile& file_;
  MeshTextures textures_;
  MeshDraft& draft_;
  std::map<std::optional<std::size_t>, GltfMaterial> known_;
};

}  // namespace svnet::simulation
