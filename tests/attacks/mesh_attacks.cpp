// Meshes that promise more than they hold, point where they must not, or unpack to what fills the memory.
#include <fstream>
#include <functional>
#include <limits>

#include "attacks.h"
#include "simulation/glb_writer.h"

namespace svnet::attacks {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A collection per attack, with one mesh.
class Collections {
 public:
  explicit Collections(fs::path folder) : folder_(std::move(folder)) {}

  void add(const std::string& name, const std::string& file, const std::string& contents,
           const std::vector<std::pair<std::string, std::string>>& beside = {}) {
    const fs::path category = folder_ / name / "things";
    fs::create_directories(category);
    std::uint64_t bytes = write(category / file, contents);
    for (const auto& [path, more] : beside) bytes += write(category / path, more);
    attacks_.push_back({name, folder_ / name, bytes});
  }
  std::vector<Attack> attacks() && { return std::move(attacks_); }

 private:
  static std::uint64_t write(const fs::path& path, const std::string& contents) {
    std::ofstream(path, std::ios::binary).write(contents.data(), static_cast<std::streamsize>(contents.size()));
    return contents.size();
  }

  fs::path folder_;
  std::vector<Attack> attacks_{};
};

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

std::string big_endian(std::uint32_t number) {
  return {static_cast<char>(number >> 24), static_cast<char>(number >> 16), static_cast<char>(number >> 8),
          static_cast<char>(number)};
}

/// CRC-32 of PNG (ISO 3309).
std::uint32_t crc(const std::string& bytes) {
  std::uint32_t value = ~0u;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0u);
  }
  return ~value;
}
std::string png_chunk(const std::string& kind, const std::string& contents) {
  return big_endian(static_cast<std::uint32_t>(contents.size())) + kind + contents + big_endian(crc(kind + contents));
}
std::string png_header(std::uint32_t width, std::uint32_t height) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5));
}

constexpr const char* kTriangle = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
std::string textured(const std::string& texture) { return "newmtl paint\nKd 1 1 1\nmap_Kd " + texture + "\n"; }
const std::string kTexturedObj = "mtllib a.mtl\n" + std::string(kTriangle) + "usemtl paint\nf 1/1 2/2 3/3\n";

void add_counts(Collections& all) {
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex ",
                    xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "property list uchar int vertex_indices\nend_header\n";
  all.add("ply_of_four_billion_faces", "a.ply",
          ply + "3" + xyz + "element face 4000000000\n" + faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  all.add("ply_of_2_to_the_63_points", "a.ply", ply + "9223372036854775807" + xyz + "end_header\n0 0 0\n");
  all.add("ply_of_a_negative_count", "a.ply", ply + "-1" + xyz + "end_header\n");
  all.add("ply_face_of_255_corners", "a.ply",
          ply + "3" + xyz + "element face 1\n" + faces + "0 0 0\n1 0 0\n0 1 0\n255 0 1 2\n");
  std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 1" + xyz +
                       "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  all.add("ply_list_of_four_billion", "a.ply", binary + std::string(12, '\0') + "\xff\xff\xff\xff");
  all.add("ply_of_100000_properties", "a.ply",
          ply + "1\n" + repeated("property float x\n", 100'000) + "end_header\n0\n");
  all.add("ply_of_noise", "a.ply", "ply\nformat binary_little_endian 1.0\n" + std::string(100'000, '\xff'));
  all.add("stl_of_four_billion_triangles", "a.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(50, '\0'));
  all.add("stl_without_end", "a.stl", "solid a\n" + repeated("facet normal 0 0 0\n", 100'000));
  all.add("obj_corner_beyond", "a.obj", std::string(kTriangle) + "f 1 2 4000000000\n");
  all.add("obj_corner_before", "a.obj", std::string(kTriangle) + "f -1 -2 -9223372036854775808\n");
  all.add("obj_without_faces", "a.obj", repeated(kTriangle, 1000));
  all.add("obj_of_nothing_but_nul", "a.obj", std::string(100'000, '\0'));
  all.add("obj_of_one_long_line", "a.obj", std::string(kTriangle) + "f" + std::string(5'000'000, ' ') + "1");
}

void add_numbers(Collections& all) {
  all.add("obj_of_nan", "a.obj", "v nan nan nan\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n");
  all.add("obj_of_infinity", "a.obj", "v inf 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n");
  all.add("obj_of_1e308", "a.obj", "v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n");
  GlbWriter glb;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  glb.attributes()["POSITION"] = glb.accessor(packed<float>({nan, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), "VEC3", 4);
  all.add("glb_of_nan", "a.glb", glb.file());
  GlbWriter huge;
  huge.json["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
  all.add("glb_scaled_beyond_numbers", "a.glb", huge.file());
}

void add_paths(Collections& all) {
  all.add("mtl_that_climbs", "a.obj", "mtllib ../../../../../../etc/passwd\n" + std::string(kTriangle) + "f 1 2 3\n");
  all.add("texture_that_climbs", "a.obj", kTexturedObj, {{"a.mtl", textured("../../../../../../../../etc/passwd")}});
  all.add("texture_that_climbs_backwards", "a.obj", kTexturedObj,
          {{"a.mtl", textured("..\\..\\..\\..\\..\\..\\etc\\passwd")}});
  all.add("texture_by_absolute_path", "a.obj", kTexturedObj, {{"a.mtl", textured("/etc/passwd")}});
  for (const auto& [name, uri] :
       {std::pair("gltf_buffer_that_climbs", "../../../../../../etc/passwd"),
        std::pair("gltf_buffer_that_climbs_encoded", "%2e%2e/%2e%2e/%2e%2e/%2e%2e/etc/passwd"),
        std::pair("gltf_buffer_of_a_file_url", "file:///etc/passwd"),
        std::pair("gltf_buffer_of_the_web", "http://127.0.0.1:1/x.bin")}) {
    GlbWriter glb;
    Json json = glb.json;
    json["buffers"] = {{{"byteLength", 1000}, {"uri", uri}}};
    all.add(name, "a.gltf", json.dump());
  }
}

void add_graphs(Collections& all) {
  const auto with = [&](const char* name, const std::function<void(Json&)>& change) {
    GlbWriter glb;
    change(glb.json);
    all.add(name, "a.glb", glb.file());
  };
  with("gltf_node_of_itself", [](Json& j) { j["nodes"][0]["children"] = {0}; });
  with("gltf_nodes_in_a_circle", [](Json& j) {
    j["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}};
  });
  with("gltf_nodes_that_double", [](Json& j) {
    j["nodes"] = Json::array();
    for (int i = 0; i < 40; ++i) j["nodes"].push_back({{"children", {i + 1, i + 1}}});
    j["nodes"].push_back({{"mesh", 0}});
  });
  with("gltf_nodes_100000_deep", [](Json& j) {
    j["nodes"] = Json::array();
    for (int i = 0; i < 100'000; ++i) j["nodes"].push_back({{"children", {i + 1}}});
    j["nodes"].push_back({{"mesh", 0}});
  });
  with("gltf_node_beyond", [](Json& j) { j["nodes"][0]["children"] = {4'000'000'000u}; });
  with("gltf_negative_node", [](Json& j) { j["scenes"][0]["nodes"] = {-1}; });
  with("gltf_accessor_beyond_its_view", [](Json& j) { j["accessors"][0]["count"] = 1'000'000'000; });
  with("gltf_accessor_that_overflows", [](Json& j) { j["accessors"][0]["count"] = std::uint64_t{1} << 62; });
  with("gltf_accessor_offset_that_overflows",
       [](Json& j) { j["accessors"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max(); });
  with("gltf_view_beyond_its_buffer", [](Json& j) { j["bufferViews"][0]["byteLength"] = std::uint64_t{1} << 40; });
  with("gltf_view_offset_that_overflows",
       [](Json& j) { j["bufferViews"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3; });
  with("gltf_stride_of_2_to_the_62", [](Json& j) { j["bufferViews"][0]["byteStride"] = std::uint64_t{1} << 62; });
  with("gltf_sparse_of_nothing", [](Json& j) {
    j["accessors"][0]["sparse"] = {{"count", 1'000'000'000},
                                   {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                   {"values", {{"bufferView", 0}}}};
  });
  with("gltf_empty_accessor_of_a_billion", [](Json& j) {
    j["accessors"][0].erase("bufferView");
    j["accessors"][0]["count"] = 1'000'000'000;
  });
  with("gltf_indices_beyond", [](Json& j) {
    j["accessors"][1]["componentType"] = 5121;
    j["accessors"][1]["count"] = 12;
    j["accessors"][0]["count"] = 1;
  });
  with("gltf_scene_beyond", [](Json& j) { j["scene"] = 7; });
  with("gltf_of_strings", [](Json& j) { j["nodes"] = "nodes"; });
  with("gltf_extension_that_is_required", [](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
  const std::string glb = GlbWriter().file();
  all.add("glb_cut_in_half", "a.glb", glb.substr(0, glb.size() / 2));
  all.add("glb_of_a_longer_chunk", "a.glb", std::string(glb).replace(12, 4, "\xff\xff\xff\x7f"));
  all.add("gltf_of_a_million_brackets", "a.gltf", std::string(1'000'000, '['));
  all.add("gltf_of_a_million_objects", "a.gltf", repeated("{\"a\":", 200'000));
  all.add(
      "gltf_of_a_data_uri_that_is_none", "a.gltf",
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
      R"("count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("buffers":[{"byteLength":36,"uri":"data:,%00%00"}]})");
}

void add_textures(Collections& all) {
  const auto with = [&](const char* name, const char* file, const std::string& contents) {
    all.add(name, "a.obj", kTexturedObj, {{"a.mtl", textured(file)}, {file, contents}});
  };
  with("png_of_100000_by_100000", "t.png",
       png_header(100'000, 100'000) + png_chunk("IDAT", "x") + png_chunk("IEND", ""));
  with("png_of_2_to_the_31", "t.png", png_header(0x7fffffff, 0x7fffffff));
  with("png_without_pixels", "t.png", png_header(0, 0) + png_chunk("IEND", ""));
  with("png_of_8000_by_8000_that_is_empty", "t.png", png_header(8000, 8000) + png_chunk("IEND", ""));
  with("png_chunk_of_two_gigabytes", "t.png", png_header(4, 4) + big_endian(0x7fffffff) + "IDAT");
  with("jpeg_of_65535_by_65535", "t.jpg",
       std::string(
           "\xff\xd8\xff\xc0\0\x11\x08\xff\xff\xff\xff\x03\x01\x11\0\x02\x11\x01\x03\x11\x01\xff\xda\0\x0c\x03\x01"
           "\0\x02\0\x03\0\0\x3f\0",
           35));
  with("bmp_of_2_to_the_31", "t.bmp",
       "BM" + packed<std::uint32_t>({100, 0, 54, 40, 0x7fffffff, 0x7fffffff}) + packed<std::uint16_t>({1, 24}) +
           std::string(24, '\0'));
  with("tga_of_65535_by_65535", "t.tga",
       std::string("\0\0\x0a\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x18\0", 18) + std::string(100, '\xff'));
  with("tiff_directory_of_itself", "t.tif",
       std::string("II*\0", 4) + packed<std::uint32_t>({8}) + packed<std::uint16_t>({0}) + packed<std::uint32_t>({8}));
  with("tiff_of_2_to_the_31", "t.tif",
       std::string("II*\0", 4) + packed<std::uint32_t>({8}) + packed<std::uint16_t>({2, 256, 4}) +
           packed<std::uint32_t>({1, 0x7fffffff}) + packed<std::uint16_t>({257, 4}) +
           packed<std::uint32_t>({1, 0x7fffffff, 0}));
  with("gif_of_65535_by_65535", "t.gif", "GIF89a\xff\xff\xff\xff" + std::string(3, '\0') + ";");
  with("webp_of_16383_by_16383", "t.webp",
       "RIFF" + packed<std::uint32_t>({30}) + "WEBPVP8 " + packed<std::uint32_t>({18}) +
           std::string("\x10\0\0\x9d\x01\x2a\xff\x3f\xff\x3f", 10) + std::string(8, '\0'));
  with("texture_that_is_a_program", "t.png", "#!/bin/sh\nreboot\n");
}

}  // namespace

std::vector<Attack> write_mesh_attacks(const fs::path& folder) {
  Collections all(folder);
  add_counts(all);
  add_numbers(all);
  add_paths(all);
  add_graphs(all);
  add_textures(all);
  return std::move(all).attacks();
}

}  // namespace svnet::attacks
