#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The bytes of numbers as they lie in memory.
template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  std::string result(numbers.size() * sizeof(Number), '\0');
  std::memcpy(result.data(), numbers.data(), result.size());
  return result;
}

/// A binary glTF file in the making (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html): one node with a mesh
/// of one primitive, a square in z = 0 from (0, 0) to (0.1, 0.1) m of two triangles. Tests add what they are about.
class GlbWriter {
 public:
  using Json = nlohmann::json;
  static constexpr int kBytes = 5121, kShorts = 5123, kWords = 5125, kFloats = 5126;

  Json json = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", {0}}}}},
               {"nodes", {{{"mesh", 0}}}},
               {"meshes", {{{"primitives", {{{"attributes", Json::object()}, {"material", 0}}}}}}},
               {"materials", {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}}},
               {"accessors", Json::array()},
               {"bufferViews", Json::array()}};

  GlbWriter() {
    attributes()["POSITION"] = accessor(packed<float>({0, 0, 0, 0.1f, 0, 0, 0.1f, 0.1f, 0, 0, 0.1f, 0}), "VEC3", 4);
    primitive()["indices"] = accessor(packed<std::uint16_t>({0, 1, 2, 0, 2, 3}), "SCALAR", 6, kShorts);
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  Json& attributes() { return primitive()["attributes"]; }
  Json& material() { return json["materials"][0]; }
  Json& pbr() { return material()["pbrMetallicRoughness"]; }

  std::size_t view(const std::string& bytes) {
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_ += bytes;
    while (binary_.size() % 4 != 0) binary_ += '\0';
    return json["bufferViews"].size() - 1;
  }

  std::size_t accessor(const std::string& bytes, const char* type, std::size_t count, int component = kFloats,
                       bool normalized = false) {
    Json description = {{"bufferView", view(bytes)}, {"componentType", component}, {"count", count}, {"type", type}};
    if (normalized) description["normalized"] = true;
    json["accessors"].push_back(description);
    return json["accessors"].size() - 1;
  }

  /// The index of a texture whose image is this file.
  std::size_t texture(const std::string& image, const char* mime = "image/png") {
    json["images"].push_back({{"bufferView", view(image)}, {"mimeType", mime}});
    json["textures"].push_back({{"source", json["images"].size() - 1}});
    return json["textures"].size() - 1;
  }

  /// Coordinates of a set, the same at all four points.
  void put_at(const std::string& set, float u, float v) {
    attributes()[set] = accessor(packed<float>({u, v, u, v, u, v, u, v}), "VEC2", 4);
  }

  std::string file() const {
    Json whole = json;
    whole["buffers"] = {{{"byteLength", binary_.size()}}};
    const std::string chunks = chunk("JSON", whole.dump(), ' ') + chunk(std::string("BIN\0", 4), binary_, '\0');
    return "glTF" + packed<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
  }

  const std::string& binary() const { return binary_; }

 private:
  static std::string chunk(const std::string& kind, std::string contents, char filler) {
    while (contents.size() % 4 != 0) contents += filler;
    return packed<std::uint32_t>({static_cast<std::uint32_t>(contents.size())}) + kind + contents;
  }

  std::string binary_;
};
