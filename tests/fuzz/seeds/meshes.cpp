// Meshes of a few triangles in every format and variant.
#include "io/images/image_codecs.h"
#include "seeds.h"
#include "simulation/glb_writer.h"

namespace svnet::fuzz {
namespace {

void add_obj(const Seeds& seeds) {
  seeds.add("mesh_obj", "square",
            "mtllib m.mtl\no thing\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nusemtl skin\n"
            "f 1/1/1 2/2/1 3/1/1\nf -4//1 -2//1 -1//1\nf 1/1 2/2 3/1 4/2 \\\n 1/1\n# end\n");
  seeds.add("mesh_obj", "concave", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 .5 0\nv 0 2 0\nf 1 2 3 4 5\ng a\ns off\nl 1 2\n");
  seeds.add("mtl", "full",
            "newmtl skin\nKd 1 0.5 0\nPm 1\nmap_Kd -s 2 2 1 -o .1 0 -clamp on a b.png\nmap_Pm -bm 1 m.jpg\n"
            "newmtl b\nKd spectral x\nd 0.5\nTr 1\nillum 2\n");
  for (const char* word :
       {"v ", "vt ", "vn ", "f ", "usemtl ", "mtllib ", "\\\n", "//", "-1", "4294967296", "nan", "1e39"})
    seeds.add_word("mesh_obj", word);
  for (const char* word : {"newmtl ", "Kd ", "Pm ", "map_Kd ", "map_Pm ", "-s ", "-o ", "-clamp on ", "-mm ", "-bm "})
    seeds.add_word("mtl", word);
}

std::string ply_header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\ncomment TextureFile a.png\n" + rest + "end_header\n";
}

void add_ply(const Seeds& seeds) {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n",
                    faces = "element face 1\nproperty list uchar int vertex_indices\n",
                    points = packed<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  seeds.add("mesh_ply", "text", ply_header("ascii", vertices + faces) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  seeds.add("mesh_ply", "coloured",
            ply_header("ascii",
                       "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                       "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\n"
                       "property float t\nelement face 1\nproperty list uchar uint vertex_index\n"
                       "property list uchar float texcoord\n") +
                "0 0 0 1 2 3 0 0\n1 0 0 9 9 9 1 0\n0 1 0 9 9 9 0 1\n3 0 1 2 6 0 0 1 0 1 1\n");
  seeds.add("mesh_ply", "little",
            ply_header("binary_little_endian", vertices + faces) + points + '\3' + packed<std::int32_t>({0, 1, 2}));
  seeds.add(
      "mesh_ply", "big",
      ply_header("binary_big_endian", vertices + faces) + points + '\3' + packed<std::int32_t>({0, 1 << 24, 2 << 24}));
  seeds.add("mesh_ply", "strips",
            ply_header("ascii", vertices + "element tristrips 1\nproperty list int int vertex_indices\n") +
                "0 0 0\n1 0 0\n0 1 0\n5 0 1 2 -1 0\n");
  for (const char* word : {"element vertex ", "element face ", "element tristrips ", "property list ", "property ",
                           "uchar ", "int ", "float ", "double ", "vertex_indices", "texcoord", "red", "end_header\n",
                           "binary_little_endian", "binary_big_endian", "18446744073709551615", "\xff\xff\xff\xff"})
    seeds.add_word("mesh_ply", word);
}

void add_stl(const Seeds& seeds) {
  const std::string facet = packed<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + packed<std::uint16_t>({0x8210});
  std::string head(80, ' ');
  seeds.add("mesh_stl", "binary", head + packed<std::uint32_t>({1}) + facet);
  head.replace(0, 12, "COLOR=\x10\x20\x30\xff  ");
  seeds.add("mesh_stl", "magics", head + packed<std::uint32_t>({2}) + facet + facet);
  seeds.add("mesh_stl", "text",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-1 0\nendloop\nendfacet\n"
            "endsolid a\n");
  for (const char* word :
       {"solid ", "facet normal ", "outer loop", "vertex ", "endloop", "endfacet", "endsolid", "COLOR="})
    seeds.add_word("mesh_stl", word);
}

void add_gltf(const Seeds& seeds) {
  const std::string png = io::encoded_png("seed", Image{2, 2, std::vector<std::uint8_t>(12, 80)});
  seeds.add("mesh_gltf", "square", GlbWriter().file());
  GlbWriter textured;
  textured.put_at("TEXCOORD_0", 0.25f, 0.75f);
  textured.pbr()["baseColorTexture"] = {{"index", textured.texture(png)}, {"texCoord", 0}};
  textured.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  seeds.add("mesh_gltf", "textured", textured.file());
  GlbWriter tree;
  tree.json["nodes"] = {{{"children", {1, 2}}, {"scale", {2, 2, 2}}},
                        {{"mesh", 0}, {"rotation", {0, 0, 0, 1}}},
                        {{"mesh", 0}, {"translation", {1, 0, 0}}}};
  tree.primitive()["mode"] = 5;
  tree.attributes()["COLOR_0"] =
      tree.accessor(packed<std::uint8_t>(std::vector<std::uint8_t>(12, 9)), "VEC3", 4, GlbWriter::kBytes, true);
  seeds.add("mesh_gltf", "tree", tree.file());
  GlbWriter sparse;
  auto& positions = sparse.json["accessors"][0];
  positions["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", sparse.view(packed<std::uint16_t>({2}))}, {"componentType", 5123}}},
      {"values", {{"bufferView", sparse.view(packed<float>({5, 5, 5}))}}}};
  seeds.add("mesh_gltf", "sparse", sparse.file());
  seeds.add("mesh_gltf", "json",
            R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
            R"({"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)"
            R"("type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36,"byteStride":12}],"buffers":[{)"
            R"("byteLength":36,"uri":"data:application/octet-stream;base64,)"
            R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
  for (const char* word : {"\"buffers\"",
                           "\"bufferViews\"",
                           "\"accessors\"",
                           "\"sparse\"",
                           "\"indices\"",
                           "\"values\"",
                           "\"children\"",
                           "\"mesh\"",
                           "\"mode\"",
                           "\"byteOffset\"",
                           "\"byteLength\"",
                           "\"byteStride\"",
                           "\"count\"",
                           "\"componentType\"",
                           "\"type\"",
                           "\"VEC3\"",
                           "\"SCALAR\"",
                           "\"MAT4\"",
                           "\"uri\"",
                           "\"data:;base64,",
                           "\"extensionsRequired\"",
                           "\"KHR_texture_transform\"",
                           "\"KHR_materials_unlit\"",
                           "\"EXT_meshopt_compression\"",
                           "\"scale\"",
                           "\"matrix\"",
                           "18446744073709551615",
                           "-1",
                           "1e999",
                           "4294967295"})
    seeds.add_word("mesh_gltf", word);
}

}  // namespace

void add_meshes(const Seeds& seeds) {
  add_obj(seeds);
  add_ply(seeds);
  add_stl(seeds);
  add_gltf(seeds);
}

}  // namespace svnet::fuzz
