// glTF 2.0 (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html); sections in the names of the tests.
#include <catch2/catch.hpp>
#include <filesystem>

#include "glb_writer.h"
#include "io/images/image_file.h"
#include "mesh_look.h"
#include "simulation/meshes/mesh_file.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::simulation;

namespace {

struct Case {
  TemporaryFolder folder;
  GlbWriter glb;
  std::vector<std::string> warnings{};

  std::string png(const Image& image) const {
    write_png(folder.path() / "image.png", image);
    return file_contents(folder.path() / "image.png");
  }
  Mesh read(const char* name = "a.glb") { return read_text(name, glb.file()); }
  Mesh read_text(const char* name, const std::string& contents) {
    MeshReading reading;
    reading.warn = [this](const std::string& line) { warnings.push_back(line); };
    return read_mesh(folder.write(name, contents), reading);
  }
  std::string refusal() {
    try {
      read();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "read";
  }
};

constexpr std::uint8_t kRed[] = {255, 0, 0}, kBlue[] = {0, 0, 255};

/// Red on the left, blue on the right.
Image halves() { return {1, 2, {kRed[0], kRed[1], kRed[2], kBlue[0], kBlue[1], kBlue[2]}}; }
Image plain(std::uint8_t r, std::uint8_t g, std::uint8_t b) { return {1, 1, {r, g, b}}; }

void check_colour(const Mesh& mesh, float r, float g, float b) {
  const Vec3 srgb = look_of(mesh).srgb;
  INFO(srgb.transpose());
  CHECK((srgb - Vec3(r, g, b)).cwiseAbs().maxCoeff() < 1.0f);
}

}  // namespace

TEST_CASE("glTF 3.7.2.1: COLOR_0 is linear, of floats or normalised integers") {
  Case of_floats, of_bytes, of_shorts, factor;
  of_floats.glb.attributes()["COLOR_0"] = of_floats.glb.accessor(packed(std::vector<float>(12, 0.2f)), "VEC3", 4);
  of_bytes.glb.attributes()["COLOR_0"] =
      of_bytes.glb.accessor(packed(std::vector<std::uint8_t>(16, 51)), "VEC4", 4, GlbWriter::kBytes, true);
  of_shorts.glb.attributes()["COLOR_0"] =
      of_shorts.glb.accessor(packed(std::vector<std::uint16_t>(16, 13107)), "VEC4", 4, GlbWriter::kShorts, true);
  factor.glb.pbr()["baseColorFactor"] = {0.2, 0.2, 0.2, 1};
  const float level = srgb_from_linear(0.2f);
  for (Case* one : {&of_floats, &of_bytes, &of_shorts, &factor}) check_colour(one->read(), level, level, level);
}

TEST_CASE("glTF 3.9.2: the base colour is factor times texture times vertex colour") {
  Case one;
  one.glb.pbr()["baseColorFactor"] = {0.5, 0.5, 0.05, 1};
  one.glb.pbr()["baseColorTexture"]["index"] = one.glb.texture(one.png(plain(255, 255, 0)));
  one.glb.put_at("TEXCOORD_0", 0.5f, 0.5f);
  one.glb.attributes()["COLOR_0"] =
      one.glb.accessor(packed<float>({1, 0.5f, 1, 1, 0.5f, 1, 1, 0.5f, 1, 1, 0.5f, 1}), "VEC3", 4);
  check_colour(one.read(), srgb_from_linear(0.5f), srgb_from_linear(0.25f), 0);
}

TEST_CASE("glTF 3.9.1: a texture names its set of coordinates") {
  for (const int set : {0, 1}) {
    Case one;
    one.glb.put_at("TEXCOORD_0", 0.75f, 0.5f);
    one.glb.put_at("TEXCOORD_1", 0.25f, 0.5f);
    one.glb.pbr()["baseColorTexture"] = {{"index", one.glb.texture(one.png(halves()))}, {"texCoord", set}};
    check_colour(one.read(), set == 1 ? 255 : 0, 0, set == 1 ? 0 : 255);
  }
  Case lost;
  lost.glb.pbr()["baseColorTexture"] = {{"index", lost.glb.texture(lost.png(halves()))}};
  check_colour(lost.read(), 255, 255, 255);
  REQUIRE(lost.warnings.size() == 1);
  CHECK_THAT(lost.warnings[0],
             Catch::EndsWith("a textured part has no TEXCOORD_0; it is rendered without the texture"));
}

TEST_CASE("glTF KHR_texture_transform: offset, scale, rotation and its own set of coordinates") {
  const auto seen = [](const GlbWriter::Json& transform, float u, float v) {
    Case one;
    one.glb.put_at("TEXCOORD_0", u, v);
    one.glb.put_at("TEXCOORD_1", 0.25f, 0.75f);
    one.glb.pbr()["baseColorTexture"] = {{"index", one.glb.texture(one.png({2,
                                                                            2,
                                                                            {255, 0, 0, 0, 255, 0,  // above
                                                                             0, 0, 255, 255, 255, 255}}))},
                                         {"extensions", {{"KHR_texture_transform", transform}}}};
    one.glb.json["extensionsRequired"] = {"KHR_texture_transform"};
    const Vec3 srgb = look_of(one.read()).srgb / 255;
    return srgb.isApprox(Vec3(1, 0, 0))   ? "upper left"
           : srgb.isApprox(Vec3(0, 1, 0)) ? "upper right"
           : srgb.isApprox(Vec3(0, 0, 1)) ? "lower left"
                                          : "lower right";
  };
  CHECK(seen({{"offset", {-0.5, 0}}}, 0.75f, 0.25f) == std::string("upper left"));
  CHECK(seen({{"offset", {0, 0.5}}}, 0.75f, 0.25f) == std::string("lower right"));
  CHECK(seen({{"scale", {0.5, 2}}}, 0.8f, 0.3f) == std::string("lower left"));
  // A quarter turn counter-clockwise, as v points down: (u, v) is at (v, -u).
  CHECK(seen({{"rotation", 1.5707963267948966}}, 0.3f, 0.2f) == std::string("lower left"));
  CHECK(seen({{"rotation", 1.5707963267948966}, {"offset", {0, 1}}}, 0.8f, 0.7f) == std::string("upper right"));
  CHECK(seen({{"texCoord", 1}}, 0.8f, 0.2f) == std::string("lower left"));
}

TEST_CASE("glTF 3.6.2.2: coordinates of textures may be normalised integers") {
  Case one;
  one.glb.attributes()["TEXCOORD_0"] =
      one.glb.accessor(packed<std::uint16_t>({16384, 32768, 16384, 32768, 16384, 32768, 16384, 32768}), "VEC2", 4,
                       GlbWriter::kShorts, true);
  one.glb.pbr()["baseColorTexture"]["index"] = one.glb.texture(one.png(halves()));
  check_colour(one.read(), 255, 0, 0);
}

TEST_CASE("glTF 3.9.2: metalness is factor times the texture's blue channel, 1 by default") {
  const auto metal = [](const GlbWriter::Json& factor, const Image* texture) {
    Case one;
    one.glb.put_at("TEXCOORD_0", 0.25f, 0.5f);
    if (factor.is_null())
      one.glb.pbr().erase("metallicFactor");
    else
      one.glb.pbr()["metallicFactor"] = factor;
    if (texture) one.glb.pbr()["metallicRoughnessTexture"]["index"] = one.glb.texture(one.png(*texture));
    return look_of(one.read()).metal;
  };
  const Image no_metal = plain(255, 255, 0), all_metal = plain(0, 0, 255), left_not = halves();
  CHECK(metal(nullptr, nullptr) == Approx(1));
  CHECK(metal(0, nullptr) == 0);
  CHECK(metal(0.2, &all_metal) == 0);
  CHECK(metal(nullptr, &no_metal) == 0);
  CHECK(metal(nullptr, &all_metal) == Approx(1));
  CHECK(metal(nullptr, &left_not) == 0);
}

TEST_CASE("glTF KHR_materials_unlit and specular-glossiness are no metal") {
  Case unlit;
  unlit.glb.pbr() = {{"baseColorFactor", {0.5, 0, 0, 1}}};
  unlit.glb.material()["extensions"]["KHR_materials_unlit"] = GlbWriter::Json::object();
  unlit.glb.json["extensionsRequired"] = {"KHR_materials_unlit"};
  CHECK(look_of(unlit.read()).metal == 0);
  check_colour(unlit.read(), srgb_from_linear(0.5f), 0, 0);

  Case glossy;
  glossy.glb.put_at("TEXCOORD_0", 0.25f, 0.5f);
  glossy.glb.material() = {{"extensions",
                            {{"KHR_materials_pbrSpecularGlossiness",
                              {{"diffuseFactor", {0.5, 1, 1, 1}},
                               {"diffuseTexture", {{"index", glossy.glb.texture(glossy.png(halves()))}}}}}}}};
  glossy.glb.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  CHECK(look_of(glossy.read()).metal == 0);
  check_colour(glossy.read(), srgb_from_linear(0.5f), 0, 0);
}

TEST_CASE("glTF 3.12: an extension that is required and not read is refused by its name") {
  for (const auto& [name, advice] : {std::pair("KHR_draco_mesh_compression", "save it without Draco compression"),
                                     std::pair("EXT_meshopt_compression", "save it without meshopt compression"),
                                     std::pair("KHR_texture_basisu", "convert its KTX2 textures to PNG or JPEG"),
                                     std::pair("ACME_foo", "save it without that extension")}) {
    Case one;
    one.glb.json["extensionsRequired"] = {name};
    CHECK_THAT(one.refusal(), Catch::EndsWith(std::string("a.glb: requires the extension ") + name +
                                              ", which is not read; " + advice));
  }
  Case draco;  // without saying so
  draco.glb.json["accessors"][0].erase("bufferView");
  draco.glb.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  CHECK_THAT(draco.refusal(), Catch::Contains("KHR_draco_mesh_compression"));
  Case fallback;  // an extension that is not required has a form that all can read beside it
  fallback.glb.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  CHECK(fallback.refusal() == "read");
  Case optional;
  optional.glb.json["extensionsUsed"] = {"ACME_foo"};
  CHECK(optional.refusal() == "read");
}

TEST_CASE("glTF EXT_texture_webp comes before the texture's usual source") {
  Case one;
  one.glb.put_at("TEXCOORD_0", 0.5f, 0.5f);
  one.glb.pbr()["baseColorTexture"]["index"] = one.glb.texture(one.png(plain(255, 0, 0)));
  one.glb.texture(one.png(plain(0, 0, 255)));
  one.glb.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
  check_colour(one.read(), 0, 0, 255);
  one.glb.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  check_colour(one.read(), 255, 255, 255);
  REQUIRE(one.warnings.size() == 1);
  CHECK_THAT(one.warnings[0], Catch::EndsWith("texture 0 has no image that is read (KHR_texture_basisu); the object "
                                              "is rendered without it"));
}

TEST_CASE("glTF KHR_mesh_quantization: integer positions count with the node's scale") {
  Case one;
  one.glb.attributes()["POSITION"] = one.glb.accessor(
      packed<std::uint16_t>({0, 0, 0, 16383, 0, 0, 16383, 8000, 0, 0, 8000, 0}), "VEC3", 4, GlbWriter::kShorts);
  one.glb.json["nodes"][0]["scale"] = {7.3e-6, 7.3e-6, 7.3e-6};
  one.glb.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Mesh mesh = one.read();
  float most = 0;
  for (const Vec3& point : mesh.points) most = std::max(most, point.x());
  CHECK(most == Approx(16383 * 7.3e-6));
}

TEST_CASE("glTF 3.5.3: transformations of nodes multiply; a mirrored one turns the triangles") {
  Case one;
  one.glb.json["nodes"] = {
      {{"children", {1}}, {"translation", {0.5, 0, 0}}, {"rotation", {0, 0, 0.70710678, 0.70710678}}},
      {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.2, 1}}}};
  const Mesh mesh = one.read();
  // (0.1, 0, 0) -> (-0.1, 0, 0.2) -> turned by 90° about z (0, -0.1, 0.2) -> moved by 0.5 along x.
  bool found = false;
  for (const Vec3& point : mesh.points) found |= point.isApprox(Vec3(0.5f, -0.1f, 0.2f), 1e-5f);
  CHECK(found);
  CHECK(mesh.normals[0][0].isApprox(Vec3(0, 0, 1), 1e-5f));
  one.glb.json["nodes"][1]["children"] = {0};
  CHECK_THAT(one.refusal(), Catch::Contains("its nodes are no tree"));
}

TEST_CASE("glTF 3.6.2.3: sparse accessors change single elements") {
  Case one;
  const auto places = one.glb.view(packed<std::uint16_t>({2})), values = one.glb.view(packed<float>({0.3f, 0.3f, 0}));
  one.glb.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", GlbWriter::kShorts}}},
      {"values", {{"bufferView", values}}}};
  float most = 0;
  for (const Vec3& point : one.read().points) most = std::max(most, point.x());
  CHECK(most == Approx(0.3));
}

TEST_CASE("glTF 3.7.2.1: strips and fans are triangles, points and lines are not") {
  for (const auto& [mode, triangles] : {std::pair(4, 2), std::pair(5, 4), std::pair(6, 4)}) {
    Case one;
    one.glb.primitive()["mode"] = mode;
    CHECK(one.read().triangles.size() == static_cast<std::size_t>(triangles));
  }
  Case lines;
  lines.glb.primitive()["mode"] = 1;
  CHECK_THAT(lines.refusal(), Catch::EndsWith("holds no triangles"));
}

TEST_CASE("a glTF file is JSON, with its buffers and images beside it or in data URIs") {
  Case one;
  one.png(halves());
  one.glb.put_at("TEXCOORD_0", 0.25f, 0.5f);
  one.glb.json["images"] = {{{"uri", "my%20textures/image.png"}}};
  one.glb.json["textures"] = {{{"source", 0}}};
  one.glb.pbr()["baseColorTexture"]["index"] = 0;
  std::filesystem::create_directories(one.folder.path() / "my textures");
  std::filesystem::rename(one.folder.path() / "image.png", one.folder.path() / "my textures/image.png");
  auto json = one.glb.json;
  json["buffers"] = {{{"byteLength", one.glb.binary().size()}, {"uri", "a%2Bb.bin"}}};
  one.folder.write("a+b.bin", one.glb.binary());
  check_colour(one.read_text("a.gltf", json.dump()), 255, 0, 0);
  CHECK(one.warnings.empty());
  json["images"] = {{{"uri",
                      "data:image/png;base64,"
                      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNg+M8AAAICAQB7CYF4AAAAAElFTkSuQmCC"}}};
  CHECK(one.read_text("b.gltf", json.dump()).images.size() == 1);
  json["buffers"][0]["uri"] = "gone.bin";
  CHECK_THROWS_WITH(one.read_text("c.gltf", json.dump()), Catch::Contains("its buffer 'gone.bin' is missing"));
}

TEST_CASE("glTF 3.8.1: a sampler repeats, mirrors or clamps the image") {
  for (const auto& [wrap, r] : {std::pair(10497, 255), std::pair(33648, 0), std::pair(33071, 0)}) {
    Case one;
    one.glb.put_at("TEXCOORD_0", 1.25f, 0.5f);
    one.glb.pbr()["baseColorTexture"]["index"] = one.glb.texture(one.png(halves()));
    one.glb.json["samplers"] = {{{"wrapS", wrap}}};
    one.glb.json["textures"][0]["sampler"] = 0;
    check_colour(one.read(), static_cast<float>(r), 0, static_cast<float>(255 - r));
  }
}
