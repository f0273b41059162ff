// PLY and STL: colours and coordinates where scanners and printers put them.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "glb_writer.h"
#include "io/images/image_file.h"
#include "mesh_look.h"
#include "simulation/meshes/mesh_file.h"
#include "simulation/meshes/mesh_unit.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::simulation;

namespace {

void check_colour(const Mesh& mesh, float r, float g, float b, float tolerance = 1) {
  const Vec3 srgb = look_of(mesh).srgb;
  INFO(srgb.transpose());
  CHECK((srgb - Vec3(r, g, b)).cwiseAbs().maxCoeff() < tolerance);
}

std::string ply(const std::string& vertex_properties, const std::string& vertex_values,
                const std::string& face_properties, const std::string& face_values, const std::string& comment = "") {
  std::string text = "ply\nformat ascii 1.0\n" + comment +
                     "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + vertex_properties +
                     "element face 1\nproperty list uchar int vertex_indices\n" + face_properties + "end_header\n";
  for (const char* place : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) text += place + vertex_values + "\n";
  return text + "3 0 1 2 " + face_values + "\n";
}

constexpr const char* kColours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

/// Packed, two facets at right angles, with these attributes.
std::string stl(const std::string& header, std::uint16_t first, std::uint16_t second) {
  std::string file = header + std::string(80 - header.size(), '\0') + packed<std::uint32_t>({2});
  file += packed<float>({0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + packed<std::uint16_t>({first});
  return file + packed<float>({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1}) + packed<std::uint16_t>({second});
}

const std::string kMagics("COLOR=\xc8\x28\x28\xff", 10);

}  // namespace

TEST_CASE("PLY: coordinates of textures per face corner, as MeshLab writes them") {
  const TemporaryFolder folder;
  write_png(folder.path() / "half.png", {1, 2, {255, 0, 0, 0, 0, 255}});
  write_png(folder.path() / "green.png", {1, 1, {0, 255, 0}});
  const std::string one = "comment TextureFile half.png\n", two = one + "comment TextureFile green.png\n";
  const char* wedge = "property list uchar float texcoord\n";
  check_colour(read_mesh(folder.write("a.ply", ply("", "", wedge, "6 0.25 0.5 0.25 0.5 0.25 0.5", one))), 255, 0, 0);
  check_colour(read_mesh(folder.write("b.ply", ply("", "", wedge, "6 0.75 0.5 0.75 0.5 0.75 0.5", one))), 0, 0, 255);
  check_colour(read_mesh(folder.write("c.ply", ply("", "", std::string(wedge) + "property int texnumber\n",
                                                   "6 0.75 0.5 0.75 0.5 0.75 0.5 1", two))),
               0, 255, 0);
  check_colour(read_mesh(folder.write("d.ply", ply("property float s\nproperty float t\n", "0.25 0.5", "", "", one))),
               255, 0, 0);
}

TEST_CASE("PLY: colours of faces and of vertices, as integers or floats, are sRGB") {
  const TemporaryFolder folder;
  const char* floats = "property float red\nproperty float green\nproperty float blue\n";
  check_colour(read_mesh(folder.write("a.ply", ply("", "", kColours, "204 63 20"))), 204, 63, 20);
  check_colour(read_mesh(folder.write("b.ply", ply(kColours, "204 63 20", "", ""))), 204, 63, 20);
  check_colour(read_mesh(folder.write("c.ply", ply(floats, "0.8 0.2 0", "", ""))), 204, 51, 0);
  for (const char* type : {"ushort", "int"}) {
    const std::string words = joined("property ", type, " red\nproperty ", type, " green\nproperty ", type, " blue\n");
    check_colour(read_mesh(folder.write("h.ply", ply(words, "204 63 20", "", ""))), 204, 63, 20);
  }
  const char* shorts = "property ushort red\nproperty ushort green\nproperty ushort blue\n";
  check_colour(read_mesh(folder.write("i.ply", ply(shorts, "52428 257 0", "", ""))), 204, 1, 0);
  check_colour(read_mesh(folder.write("f.ply", ply(floats, "204 1 0", "", ""))), 204, 1, 0);
  check_colour(read_mesh(folder.write("g.ply", ply("", "", floats, "204 1 0"))), 204, 1, 0);
  check_colour(read_mesh(folder.write("d.ply", ply(kColours, "255 255 255", kColours, "204 63 20"))), 204, 63, 20);
}

TEST_CASE("PLY: triangle strips") {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement "
      "tristrips "
      "1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 0 1 2 3\n"));
  CHECK(mesh.triangles.size() == 4);
  for (const auto& normals : mesh.normals) CHECK(normals[0].isApprox(Vec3(0, 0, 1)));
}

TEST_CASE("STL by Magics: the object's colour in the header, facets' own with bit 15 clear") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& contents) { return read_mesh(folder.write("a.stl", contents)); };
  check_colour(read(stl(kMagics, 0x8000, 0x8000)), 200, 40, 40);
  check_colour(read(stl(kMagics, 0, 0)), 200, 40, 40);  // a program that knows no colours of facets
  const std::uint16_t blue = 31 << 10;
  check_colour(read(stl(kMagics, blue, blue)), 0, 0, 255);
  check_colour(read(stl(kMagics, blue, 0x8000)), 100, 20, 147.5f);
}

TEST_CASE("STL by VisCAM: facets' colours with bit 15 set") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& contents) { return read_mesh(folder.write("a.stl", contents)); };
  const std::uint16_t red = 0x8000 | 31 << 10;
  const float grey = srgb_from_linear(0.6f);
  check_colour(read(stl("", red, red)), 255, 0, 0);
  check_colour(read(stl("", 0, 0)), grey, grey, grey);
  check_colour(read(stl("solid though packed", red, 0)), (255 + grey) / 2, grey / 2, grey / 2);
}

TEST_CASE("text STL: keywords in any case") {
  const TemporaryFolder folder;
  for (const char* text : {"SOLID A\nFACET NORMAL 0 0 0\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 "
                           "0\nENDLOOP\nENDFACET\nENDSOLID A\n",
                           "  Solid\r\n Facet Normal 0 0 0\r\n Outer Loop\r\n Vertex 0 0 0\r\n Vertex +1 0 0\r\n "
                           "Vertex 0 1e0 0\r\n EndLoop\r\n "
                           "EndFacet\r\nEndSolid\r\n"}) {
    const Mesh mesh = read_mesh(folder.write("a.STL", text));
    REQUIRE(mesh.triangles.size() == 1);
    CHECK(mesh.points.size() == 3);
  }
  CHECK_THROWS_WITH(read_mesh(folder.write("b.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n")),
                    Catch::Contains("ends inside a facet; is the file incomplete?"));
}

TEST_CASE("a mesh without a unit is metres, or what alone makes sense") {
  std::vector<std::string> lines;
  const auto unit = [&](double length, std::optional<double> given = {}) {
    return metres_per_unit(length, "a.obj", given, [&](const std::string& line) { lines.push_back(line); });
  };
  CHECK(unit(0.12) == 1);
  CHECK(unit(0.9) == 1);
  CHECK(lines.empty());
  CHECK(unit(12) == 0.01);
  CHECK(unit(120) == 0.001);
  CHECK(unit(900) == 0.001);
  CHECK(lines ==
        std::vector<std::string>{"a.obj: is 12 units long, taken as centimetres: 0.12 m (--unit decides otherwise)",
                                 "a.obj: is 120 units long, taken as millimetres: 0.12 m (--unit decides otherwise)",
                                 "a.obj: is 900 units long, taken as millimetres: 0.9 m (--unit decides otherwise)"});
  CHECK(unit(12, 0.001) == 0.001);
  CHECK_THROWS_WITH(unit(40),
                    Catch::Contains("a.obj: is 40 m long, objects may be 1 mm to 1 m; is its unit right? With "
                                    "--unit 0.001 it would be 0.04 m, with --unit 0.01 it would be 0.4 m."));
  CHECK_THROWS_WITH(unit(12, 1), Catch::EndsWith("is its unit right? With --unit 0.01 it would be 0.12 m."));
  CHECK_THROWS_WITH(unit(5000), Catch::EndsWith("is its unit right?"));
}
