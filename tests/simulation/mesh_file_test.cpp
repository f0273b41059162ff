#include "simulation/meshes/mesh_file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <tuple>

#include "io/images/image_file.h"
#include "sandbox/mode.h"
#include "simulation/meshes/mesh_check.h"
#include "simulation/texture.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::simulation;

namespace {

constexpr const char* kSquare =
    "mtllib square.mtl\nusemtl paint\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n";
constexpr const char* kStl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
    "s\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

template <class Number>
std::string bytes(const std::vector<Number>& numbers) {
  std::string result(numbers.size() * sizeof(Number), '\0');
  std::memcpy(result.data(), numbers.data(), result.size());
  return result;
}

/// A chunk of a binary glTF file: its length, its type, and its contents padded to a multiple of 4.
std::string glb_chunk(const char* kind, std::string contents, char filler) {
  while (contents.size() % 4 != 0) contents += filler;
  return bytes<std::uint32_t>({static_cast<std::uint32_t>(contents.size())}) + std::string(kind, 4) + contents;
}

/// A binary glTF file (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html): a triangle whose material takes its
/// colour from `image`, a JSON object; `image` is buffer view 3.
std::string glb_of(const std::string& image, const std::string& file) {
  const std::string points = bytes<float>({0, 0, 0, 2, 0, 0, 0, 2, 0}), uv = bytes<float>({0, 0, 1, 0, 0, 1}),
                    corners = bytes<std::uint16_t>({0, 1, 2, 0});
  const auto view = [](std::size_t offset, std::size_t length) {
    return R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) + R"(, "byteLength": )" + std::to_string(length) +
           "}";
  };
  const std::string binary = points + uv + corners + file;
  const std::string json =
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
    "textures": [{"source": 0}], "images": [)" +
      image + R"(],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [2, 2, 0]},
      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
      {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [)" +
      view(0, 36) + "," + view(36, 24) + "," + view(60, 6) + "," + view(68, file.size()) +
      R"(], "buffers": [{"byteLength": )" + std::to_string(binary.size()) + "}]}";
  const std::string chunks = glb_chunk("JSON", json, ' ') + glb_chunk(std::string("BIN\0", 4).c_str(), binary, '\0');
  return "glTF" + bytes<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

/// The image is embedded.
std::string glb(const std::string& image, const std::string& mime_type) {
  return glb_of(R"({"bufferView": 3, "mimeType": ")" + mime_type + R"("})", image);
}

/// The PNG file of an image with a red pixel above a green one.
std::string small_png(const TemporaryFolder& folder) {
  write_png(folder.path() / "small.png", {2, 1, {255, 0, 0, 0, 255, 0}});
  return file_contents(folder.path() / "small.png");
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_mesh(path);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("meshes are read with their unit, colours and textures") {
  const TemporaryFolder folder;
  const auto path = folder.write("square.obj", kSquare);
  folder.write("square.mtl", "newmtl paint\nKd 0.25 0.5 0.75\nmap_Kd paint.png\n");
  write_png(folder.path() / "paint.png", {1, 2, {255, 0, 0, 0, 255, 0}});
  const Mesh mesh = read_mesh(path, {{}, [](double) { return 0.001; }});
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.points[mesh.triangles[0].corner[1]].maxCoeff() == Approx(0.002));
  CHECK(mesh.normals[0][0].isApprox(Vec3(0, 0, 1)));
  const Material& material = mesh.materials[static_cast<std::size_t>(mesh.triangles[0].material)];
  CHECK(material.colour.isApprox(Vec3(0.25f, 0.5f, 0.75f)));
  CHECK(material.texture == Texture::image);
  REQUIRE(mesh.images.size() == 1);
  CHECK(mesh.images[0].width == 2);
  REQUIRE(mesh.uv.size() == 2);
  CHECK(mesh.uv[0][1].x() == Approx(1));

  CHECK(read_mesh(folder.write("a.stl", kStl)).triangles.size() == 1);
  CHECK(read_mesh(folder.write("a.ply", kPly)).triangles.size() == 1);
}

TEST_CASE("a mesh is read the same without the sandbox") {
  const TemporaryFolder folder;
  const auto path = folder.write("square.obj", kSquare);
  folder.write("square.mtl", "newmtl paint\nKd 0.25 0.5 0.75\nmap_Kd paint.png\n");
  write_png(folder.path() / "paint.png", {1, 2, {255, 0, 0, 0, 255, 0}});
  const Mesh in_sandbox = read_mesh(path);
  sandbox::set_mode(sandbox::Mode::off);
  const Mesh here = read_mesh(path);
  sandbox::set_mode(sandbox::Mode::on);
  CHECK(here.points == in_sandbox.points);
  CHECK(here.normals == in_sandbox.normals);
  CHECK(here.uv == in_sandbox.uv);
  REQUIRE(here.images.size() == in_sandbox.images.size());
  CHECK(here.images[0].rgb == in_sandbox.images[0].rgb);
  REQUIRE(here.materials.size() == in_sandbox.materials.size());
  CHECK(here.materials[0].colour == in_sandbox.materials[0].colour);
  CHECK(here.materials[0].image == in_sandbox.materials[0].image);
}

TEST_CASE("a mesh that makes no sense is not taken from another process") {
  const Mesh good{.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                  .triangles = {{{0, 1, 2}, 0}},
                  .normals = {{Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)}},
                  .uv = {},
                  .metal_uv = {},
                  .tints = {},
                  .materials = {Material{}},
                  .images = {}};
  CHECK(is_consistent(good));
  const auto refuses = [&](const std::function<void(Mesh&)>& change) {
    Mesh mesh = good;
    change(mesh);
    return !is_consistent(mesh);
  };
  CHECK(refuses([](Mesh& m) { m.triangles[0].corner[1] = 3; }));
  CHECK(refuses([](Mesh& m) { m.triangles[0].material = 1; }));
  CHECK(refuses([](Mesh& m) { m.triangles[0].material = -1; }));
  CHECK(refuses([](Mesh& m) { m.triangles.clear(); }));
  CHECK(refuses([](Mesh& m) { m.normals.clear(); }));
  CHECK(refuses([](Mesh& m) { m.uv.resize(2); }));
  CHECK(refuses([](Mesh& m) { m.points[2].x() = std::numeric_limits<float>::quiet_NaN(); }));
  CHECK(refuses([](Mesh& m) { m.materials[0].image = 0; }));
  CHECK(refuses([](Mesh& m) { m.materials[0].texture = static_cast<Texture>(99); }));
  CHECK(refuses([](Mesh& m) { m.materials[0].texture = Texture::image; }));
  CHECK(refuses([](Mesh& m) { m.images.push_back({2, 2, std::vector<std::uint8_t>(11)}); }));
  CHECK(refuses([](Mesh& m) { m.images.push_back({Index{1} << 40, Index{1} << 40, {}}); }));
}

TEST_CASE("a mesh has the colours of its vertices") {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.write("scan.ply", R"(ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 255 0 0
0 1 0 255 255 0
3 0 1 2
)"));
  const Material& material = mesh.materials[static_cast<std::size_t>(mesh.triangles[0].material)];
  CHECK(material.colour.isApprox(Vec3(1, 1, 1)));
  REQUIRE(mesh.tints.size() == 1);
  CHECK(((mesh.tints[0][0] + mesh.tints[0][1] + mesh.tints[0][2]) / 3).isApprox(Vec3(1, 1.0f / 3, 0)));
}

TEST_CASE("the name of a GLB's texture is an encoded URI") {
  const TemporaryFolder folder;
  small_png(folder);
  std::filesystem::rename(folder.path() / "small.png", folder.path() / "my paint%.png");
  CHECK(read_mesh(folder.write("a.glb", glb_of(R"({"uri": "my%20paint%25.png"})", "unused"))).images.size() == 1);
}

TEST_CASE("meshes that cannot be read are named in one line") {
  const TemporaryFolder folder;
  const auto in = [&](const char* name) { return (folder.path() / name).string(); };
  CHECK(refusal(folder.path() / "none.obj") ==
        in("none.obj") + ": cannot be read; expected a mesh (OBJ, PLY, STL or GLB)");
  for (const auto& [name, contents] :
       {std::pair("a.ply", "ply\nnonsense"), std::pair("b.stl", "solid"), std::pair("c.glb", "glTF"),
        std::pair("d.obj", "v 0 0 0\n"), std::pair("e.xyz", "1 2 3")}) {
    const std::string message = refusal(folder.write(name, contents));
    CHECK_THAT(message, Catch::StartsWith(in(name) + ": "));
    CHECK(message.find('\n') == std::string::npos);
  }
  const auto path = folder.write("square.obj", kSquare);
  folder.write("square.mtl", "newmtl paint\nmap_Kd ../../etc/paint.png\n");
  CHECK_THAT(refusal(path), Catch::StartsWith(in("square.obj") + ": texture '../../etc/paint.png' lies outside"));
  folder.write("square.mtl", "newmtl paint\nmap_Kd paint.png\n");
  folder.write("paint.png", "no image");
  CHECK_THAT(refusal(path), Catch::StartsWith(in("square.obj") + ": texture " + in("paint.png") + ": is no image"));
  const std::string text = kPly;
  CHECK_THAT(refusal(folder.write("f.ply", text.substr(0, text.find("1 0 0")) + "nan 0 0\n0 1 0\n3 0 1 2\n")),
             Catch::StartsWith(in("f.ply") + ": "));
}

TEST_CASE("an image inside a GLB is its texture, the right way up") {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.write("a.glb", glb(small_png(folder), "image/png")));
  REQUIRE(mesh.triangles.size() == 1);
  const Material& material = mesh.materials[static_cast<std::size_t>(mesh.triangles[0].material)];
  CHECK(material.texture == Texture::image);
  REQUIRE(mesh.images.size() == 1);
  CHECK(mesh.images[0].height == 2);
  // glTF's v points downwards: the corners with v = 0 are at the upper, red pixel.
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 corner = mesh.points[mesh.triangles[0].corner[k]];
    const Vec3 colour =
        surface_colour(material, corner, mesh.uv[0][k] + Vec2(0.01f, corner.y() > 1 ? 0.01f : -0.01f), mesh.images);
    CHECK(colour.isApprox(corner.y() > 1 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
  }
}

TEST_CASE("damaged meshes and textures are reported in one line that says where and what") {
  const TemporaryFolder folder;
  const std::string png = small_png(folder), whole = glb(png, "image/png"), ply = kPly, stl = kStl;
  std::string long_view = whole;
  long_view.replace(long_view.find("\"count\": 3"), 10, "\"count\": 9");
  std::string stranger = whole;
  stranger.replace(stranger.find("\"material\": 0"), 13, "\"material\": 7");
  // Name, contents, and a part of the message.
  const std::vector<std::tuple<const char*, std::string, const char*>> cases{
      {"empty.obj", "", ""},
      {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ""},
      {"beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", ""},
      {"words.obj", "v a b c\nf x y z\n", ""},
      {"short.ply", ply.substr(0, ply.find("1 0 0")), ""},
      {"many.ply", std::string(ply).replace(ply.find("vertex 3"), 8, "vertex 999999999"), ""},
      {"beyond.ply", std::string(ply).replace(ply.find("3 0 1 2"), 7, "3 0 1 7"), ""},
      {"short.stl", std::string(80, ' ') + bytes<std::uint32_t>({1000}) + "facet", ""},
      {"infinite.stl", std::string(stl).replace(stl.find("vertex 1"), 8, "vertex inf"), "not finite"},
      {"short.glb", whole.substr(0, whole.size() / 2), ""},
      {"header.glb", whole.substr(0, 12), ""},
      {"version.glb", "glTF" + bytes<std::uint32_t>({9, 12}), ""},
      {"json.glb", "glTF" + bytes<std::uint32_t>({2, 24}) + glb_chunk("JSON", "{{{", ' '), ""},
      {"accessor.glb", long_view, ""},
      {"material.glb", stranger, ""},
      {"text.glb", glb("no image", "image/png"), "is no image of a known kind"},
      {"page.glb", glb("<!DOCTYPE html>", "image/png"), "GIF), but a web page"},
      {"lfs.obj", "version https://git-lfs.github.com/spec/v1\n", "is not a mesh, but a Git LFS pointer"},
      {"lfs.glb", "version https://git-lfs.github.com/spec/v1\n", "is not a mesh, but a Git LFS pointer"},
      {"page.stl", "<!DOCTYPE html><html>" + std::string(100, ' '), "is not a mesh, but a web page"},
      {"packed.ply", "\x1f\x8b\x08 packed", "is not a mesh, but compressed by gzip"},
      {"cut.glb", glb(png.substr(0, png.size() - 20), "image/png"), "texture"},
      {"jpeg.glb", glb("\xff\xd8\xff\xe0 no more", "image/jpeg"), "texture"}};
  for (const auto& [name, contents, part] : cases) {
    INFO(name);
    const std::string message = refusal(folder.write(name, contents));
    CHECK_THAT(message, Catch::StartsWith((folder.path() / name).string() + ": "));
    CHECK_THAT(message, Catch::Contains(part));
    CHECK(std::all_of(message.begin(), message.end(), [](char c) { return static_cast<unsigned char>(c) >= ' '; }));
    CHECK(message.size() < 400);
  }
}

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// The triangles of kPly and a second one, packed.
std::string packed_ply() {
  std::string ply = replaced(replaced(kPly, "ascii", "binary_little_endian"), "face 1", "face 2");
  ply.resize(ply.find("end_header\n") + 11);
  ply += bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (int face = 0; face < 2; ++face) ply += '\3' + bytes<std::int32_t>({0, 1, 2});
  return ply;
}

}  // namespace

TEST_CASE("a truncated PLY file is refused with the place of its end") {
  const TemporaryFolder folder;
  const std::string text = replaced(std::string(kPly) + "3 2 1 0\n", "face 1", "face 2"), packed = packed_ply();
  const std::string path = (folder.path() / "a.ply").string();
  const auto refusal_of = [&](const std::string& contents) { return refusal(folder.write("a.ply", contents)); };
  const std::string vertices = path + ": holds 2 of 3 elements 'vertex'; is the file incomplete?",
                    faces = path + ": holds 1 of 2 elements 'face'; is the file incomplete?",
                    header = path + ": the header has no end_header; is the file cut off?",
                    promise = path + ": promises 400000000 of 'face' in ";
  for (const char* line_end : {"\n", "\r\n"}) {
    const std::string whole = replaced(text, "\n", line_end);
    CHECK(refusal_of(whole) == "read");
    CHECK(refusal_of(whole.substr(0, whole.rfind("0 1 0"))) == vertices);
    CHECK(refusal_of(whole.substr(0, whole.rfind("3 2 1 0"))) == faces);
    CHECK(refusal_of(whole.substr(0, whole.rfind("1 0"))) == faces);
    CHECK(refusal_of(whole.substr(0, whole.rfind("end_header"))) == header);
    CHECK(refusal_of(replaced(whole, "end_header", "end_headers")) == header);
    CHECK_THAT(refusal_of(replaced(whole, "face 2", "face 400000000")), Catch::StartsWith(promise));
  }
  for (const std::string& line_end : {std::string("\r"), std::string("\n\r"), std::string("\f"), std::string(1, '\0')})
    CHECK(refusal_of(replaced(text, "\n", line_end)) ==
          path + ": the header holds a control character; do its lines end with LF or CR LF?");
  CHECK(refusal_of(packed) == "read");
  CHECK(refusal_of(packed.substr(0, packed.size() - 1)) == faces);
  CHECK(refusal_of(packed.substr(0, packed.size() - 13 - 13 - 1)) == vertices);
  CHECK(refusal_of(replaced(packed, std::string(1, '\3'), "\xff")) ==
        path + ": holds 0 of 2 elements 'face'; is the file incomplete?");
}

TEST_CASE("a PLY file of polygons has more triangles than faces") {
  const TemporaryFolder folder;
  const std::string ply = replaced(replaced(kPly, "vertex 3", "vertex 4"), "3 0 1 2", "1 1 0\n4 0 1 3 2");
  CHECK(read_mesh(folder.write("a.ply", ply)).triangles.size() == 2);
}
