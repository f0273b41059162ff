#include "gltf_materials.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace svnet::simulation {
namespace {

using Json = GltfFile::Json;

io::Bytes bytes_of(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

Wrap wrap_of(std::optional<std::size_t> code) {
  constexpr std::size_t kClamp = 33071, kMirror = 33648;
  return code == kClamp ? Wrap::clamp : code == kMirror ? Wrap::mirror : Wrap::repeat;
}

}  // namespace

const GltfMaterial& GltfMaterials::of_primitive(const Json& primitive) {
  const auto number = file_.index(primitive, "material");
  const auto [place, is_new] = known_.try_emplace(number);
  if (is_new) place->second = read(number ? file_.item("materials", *number) : Json::object());
  return place->second;
}

GltfMaterial GltfMaterials::read(const Json& from) {
  const Json& usual = file_.object(from, "pbrMetallicRoughness");
  const Json& glossy = file_.extension(from, "KHR_materials_pbrSpecularGlossiness");
  // An extension may be an empty object, so ask for its name.
  const auto has_extension = [&](const char* name) { return file_.object(from, "extensions").contains(name); };
  const bool is_glossy = has_extension("KHR_materials_pbrSpecularGlossiness");
  const Json& colour_texture =
      file_.object(is_glossy ? glossy : usual, is_glossy ? "diffuseTexture" : "baseColorTexture");
  const auto factor =
      file_.numbers(is_glossy ? glossy : usual, is_glossy ? "diffuseFactor" : "baseColorFactor", {1.0, 1.0, 1.0, 1.0});
  Material material;
  for (std::size_t c = 0; c < 3; ++c)
    material.colour[static_cast<Eigen::Index>(c)] = factor[c] > 0 ? static_cast<float>(std::min(factor[c], 1.0)) : 0.0f;
  material.second = material.colour;
  GltfMaterial result;
  if (const auto image = texture(colour_texture)) {
    material.texture = Texture::image;
    material.image = *image;
    material.wrap = wrap(file_.item("textures", *file_.index(colour_texture, "index")));
    result.image = coordinates(colour_texture);
  }
  if (!is_glossy && !has_extension("KHR_materials_unlit")) {
    material.metal_factor = static_cast<float>(file_.number(usual, "metallicFactor", 1));
    material.metal = material.metal_factor > 0.5f;
    const Json& metal_texture = file_.object(usual, "metallicRoughnessTexture");
    if (material.metal)  // less than half, whatever the texture says
      if (const auto image = texture(metal_texture)) {
        material.metal_image = *image;
        result.metal_image = coordinates(metal_texture);
      }
  }
  result.index = draft_.add(material);
  return result;
}

std::optional<int> GltfMaterials::texture(const Json& from) {
  const auto number = file_.index(from, "index");
  if (!number) return std::nullopt;
  const Json& description = file_.item("textures", *number);
  auto source = file_.index(file_.extension(description, "EXT_texture_webp"), "source");
  if (!source) source = file_.index(description, "source");
  if (source) return image(*source);
  std::string extensions;
  for (const auto& [name, value] : file_.object(description, "extensions").items()) extensions += " " + printable(name);
  file_.files().warn(joined("texture ", *number, " has no image that is read",
                            extensions.empty() ? "" : " (" + extensions.substr(1) + ")",
                            "; the object is rendered without it"));
  return std::nullopt;
}

std::optional<int> GltfMaterials::image(std::size_t index) {
  const Json& description = file_.item("images", index);
  const std::string name = "image " + std::to_string(index);
  if (const auto view = file_.index(description, "bufferView"))
    return textures_.embedded(name, bytes_of(file_.buffer_view(*view)));
  const std::string uri = file_.text(description, "uri");
  if (const auto data = file_.data_of_uri(uri)) return textures_.embedded(name, bytes_of(*data));
  return textures_.file(decoded_uri(uri));
}

std::array<Wrap, 2> GltfMaterials::wrap(const Json& texture) const {
  const auto sampler = file_.index(texture, "sampler");
  if (!sampler) return {Wrap::repeat, Wrap::repeat};
  const Json& description = file_.item("samplers", *sampler);
  return {wrap_of(file_.index(description, "wrapS")), wrap_of(file_.index(description, "wrapT"))};
}

TextureCoordinates GltfMaterials::coordinates(const Json& info) const {
  TextureCoordinates result;
  const Json& moved = file_.extension(info, "KHR_texture_transform");
  result.set = file_.index(moved, "texCoord").value_or(file_.index(info, "texCoord").value_or(0));
  const auto offset = file_.numbers(moved, "offset", {0.0, 0.0}), scale = file_.numbers(moved, "scale", {1.0, 1.0});
  // Counter-clockwise where v points down, as the extension's prose, its test model and all viewers have it; the matrix
  // that the extension prints turns the other way.
  const double angle = file_.number(moved, "rotation", 0), c = std::cos(angle), s = std::sin(angle);
  result.turn << c * scale[0], s * scale[1], -s * scale[0], c * scale[1];
  result.offset << offset[0], offset[1];
  return result;
}

}  // namespace svnet::simulation
