// Wavefront OBJ and MTL; names of textures and materials as they are written.
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
namespace fs = std::filesystem;

namespace {

constexpr const char* kSquare =
    "mtllib a.mtl\nusemtl paint\nv 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nvt 0.5 0.5\nf 1/1 2/1 3/1 4/1\n";

/// A folder of a collection, COLLECTION/thing/a.obj.
struct Case {
  TemporaryFolder folder;
  std::vector<std::string> warnings{};

  fs::path write(const fs::path& relative, const std::string& contents) const {
    return folder.write("collection" / relative, contents);
  }
  void image(const fs::path& relative, std::uint8_t r, std::uint8_t g, std::uint8_t b) const {
    fs::create_directories((folder.path() / "collection" / relative).parent_path());
    write_png(folder.path() / "collection" / relative, {1, 1, {r, g, b}});
  }
  Mesh read(const fs::path& relative = "thing/a.obj") {
    MeshReading reading;
    reading.collection = folder.path() / "collection";
    reading.warn = [this](const std::string& line) { warnings.push_back(line); };
    return read_mesh(folder.path() / "collection" / relative, reading);
  }
  Mesh read_square(const std::string& materials) {
    write("thing/a.mtl", materials);
    write("thing/a.obj", kSquare);
    return read();
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

void check_colour(const Mesh& mesh, float r, float g, float b) {
  const Vec3 srgb = look_of(mesh).srgb;
  INFO(srgb.transpose());
  CHECK((srgb - Vec3(r, g, b)).cwiseAbs().maxCoeff() < 1.0f);
}

}  // namespace

TEST_CASE("MTL: Kd times map_Kd; Kd 0 0 0 beside a texture leaves the texture alone") {
  const float half = srgb_from_linear(0.5f);
  Case one;
  one.image("thing/t.png", 255, 255, 0);
  check_colour(one.read_square("newmtl paint\nKd 0.5 0.25 1\nmap_Kd t.png\n"), half, srgb_from_linear(0.25f), 0);
  check_colour(one.read_square("newmtl paint\nKd 0 0 0\nmap_Kd t.png\n"), 255, 255, 0);
  check_colour(one.read_square("newmtl paint\nmap_Kd t.png\n"), 255, 255, 0);
  check_colour(one.read_square("newmtl paint\nKd 0 0 0\n"), 0, 0, 0);
  check_colour(one.read_square("NEWMTL paint\nkd 0.5 0.5 0\nMAP_KD t.png\n"), half, half, 0);
  CHECK(one.warnings.empty());
}

TEST_CASE("MTL: options before a texture's name, blanks and quotes in it, blanks after it") {
  Case one;
  one.image("thing/my paint.png", 255, 0, 0);
  for (const char* name :
       {"my paint.png", "my paint.png  \t", "\"my paint.png\"", "-clamp on -bm 0.5 -o 0.5 0.5 0 -s 2 2 my paint.png"})
    check_colour(one.read_square(std::string("newmtl paint \nmap_Kd ") + name + "\r\n"), 255, 0, 0);
  one.image("thing/-mm.png", 0, 0, 255);
  check_colour(one.read_square("newmtl paint\nmap_Kd -mm.png\n"), 0, 0, 255);
  // -s and -o move the coordinates.
  fs::create_directories(one.folder.path() / "collection/thing");
  write_png(one.folder.path() / "collection/thing/halves.png", {1, 2, {255, 0, 0, 0, 0, 255}});
  check_colour(one.read_square("newmtl paint\nmap_Kd -o 0.75 0 0 halves.png\n"), 255, 0, 0);
  check_colour(one.read_square("newmtl paint\nmap_Kd -s 1.5 1 1 halves.png\n"), 0, 0, 255);
  CHECK(one.warnings.empty());
}

TEST_CASE("names in OBJ may have blanks after them") {
  Case one;
  one.image("thing/t.png", 255, 0, 0);
  one.write("thing/a.mtl", "newmtl paint \nKd 1 1 1 \nmap_Kd t.png \n");
  std::string obj = kSquare;
  obj.replace(obj.find("a.mtl\n"), 6, "a.mtl \n").replace(obj.find("paint\n"), 6, "paint \n");
  one.write("thing/a.obj", obj);
  check_colour(one.read(), 255, 0, 0);
  CHECK(one.warnings.empty());
}

TEST_CASE("textures are looked up as they are written, with / or \\, anywhere in the collection") {
  for (const auto& [file, written] :
       {std::pair("thing/textures/t.png", "textures/t.png"), std::pair("thing/textures/t.png", "textures\\t.png"),
        std::pair("thing/textures/t.png", ".\\textures\\t.png"), std::pair("images/t.png", "../images/t.png"),
        std::pair("images/t.png", "..\\images\\t.png"), std::pair("thing/t.png", "../thing/./t.png")}) {
    Case one;
    INFO(written);
    one.image(file, 255, 0, 0);
    check_colour(one.read_square(std::string("newmtl paint\nmap_Kd ") + written + "\n"), 255, 0, 0);
    CHECK(one.warnings.empty());
  }
}

TEST_CASE("two textures of one file name in two folders are two textures") {
  Case one;
  one.image("thing/a/t.png", 255, 0, 0);
  one.image("thing/b/t.png", 0, 0, 255);
  one.write("thing/a.mtl", "newmtl one\nmap_Kd a/t.png\nnewmtl two\nmap_Kd b/t.png\nnewmtl same\nmap_Kd ./a/t.png\n");
  one.write(
      "thing/a.obj",
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nusemtl one\nf 1/1 2/1 3/1\nusemtl two\nf 1/1 3/1 "
      "4/1\nusemtl same\nf 1/1 2/1 4/1\n");
  const Mesh mesh = one.read();
  REQUIRE(mesh.images.size() == 2);
  CHECK(mesh.images[0].rgb != mesh.images[1].rgb);
}

TEST_CASE("a texture or material file outside the collection is refused") {
  Case one;
  const std::string outside = one.folder.write("secret.png", "").string();
  one.image("../secret.png", 255, 0, 0);
  for (const std::string& written : {std::string("../../secret.png"), outside, std::string("C:\\maps\\paint.png")}) {
    one.write("thing/a.mtl", "newmtl paint\nmap_Kd " + written + "\n");
    one.write("thing/a.obj", kSquare);
    CHECK(one.refusal() == (one.folder.path() / "collection/thing/a.obj").string() + ": texture '" + written +
                               "' lies outside the collection " + (one.folder.path() / "collection").string() +
                               "; copy it there and name it by a relative path");
  }
  one.write("thing/a.obj", "mtllib ../../a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  CHECK_THAT(one.refusal(), Catch::Contains("material file '../../a.mtl' lies outside the collection"));
  // An absolute path of the machine that wrote the file: the same name beside the mesh is taken.
  one.image("thing/paint.png", 255, 0, 0);
  check_colour(one.read_square("newmtl paint\nmap_Kd C:\\maps\\paint.png\n"), 255, 0, 0);
  REQUIRE(one.warnings.size() == 1);
  CHECK_THAT(one.warnings[0], Catch::EndsWith("texture 'C:\\maps\\paint.png' is taken from beside the mesh"));
}

TEST_CASE("a mesh that is a symbolic link has its textures beside the link or beside its target") {
  Case one;
  one.folder.write("scans/one/a.obj", kSquare);
  one.folder.write("scans/one/a.mtl", "newmtl paint\nmap_Kd ../textures/t.png\n");
  fs::create_directories(one.folder.path() / "scans/textures");
  write_png(one.folder.path() / "scans/textures/t.png", {1, 1, {255, 0, 0}});
  fs::create_directories(one.folder.path() / "collection/thing");
  fs::create_symlink(one.folder.path() / "scans/one/a.obj", one.folder.path() / "collection/thing/a.obj");
  check_colour(one.read(), 255, 0, 0);
  one.folder.write("scans/one/a.mtl", "newmtl paint\nmap_Kd ../../t.png\n");
  CHECK_THAT(one.refusal(), Catch::Contains("lies outside the collection"));
}

TEST_CASE("Gazebo's models have their textures in materials/textures beside meshes") {
  Case one;
  one.image("thing/model/materials/textures/t.png", 255, 0, 0);
  one.write("thing/model/meshes/a.mtl", "newmtl paint\nmap_Kd t.png\n");
  one.write("thing/model/meshes/a.obj", kSquare);
  check_colour(one.read("thing/model/meshes/a.obj"), 255, 0, 0);
}

TEST_CASE("what is missing is one line of warning, and the object is rendered without it") {
  const float grey = srgb_from_linear(0.6f);
  Case texture;
  check_colour(texture.read_square("newmtl paint\nKd 0.5 0 0\nmap_Kd textures/gone.png\n"), srgb_from_linear(0.5f), 0,
               0);
  REQUIRE(texture.warnings.size() == 1);
  CHECK(texture.warnings[0] == (texture.folder.path() / "collection/thing/a.obj").string() +
                                   ": texture 'textures/gone.png' is missing; the object is rendered without it");
  Case materials;
  materials.write("thing/a.obj", kSquare);
  check_colour(materials.read(), grey, grey, grey);
  REQUIRE(materials.warnings.size() == 1);
  CHECK_THAT(materials.warnings[0],
             Catch::EndsWith("a.obj: material file 'a.mtl' is missing; the object is rendered without it"));
  Case material;
  check_colour(material.read_square("newmtl point\nKd 1 1 1\n"), grey, grey, grey);
  REQUIRE(material.warnings.size() == 1);
  CHECK_THAT(material.warnings[0], Catch::EndsWith("material 'paint' is in no material file; its faces are grey"));
}

TEST_CASE("textures are PNG, BMP, TGA, GIF or TIFF, told by their contents") {
  const std::string bmp = "BM" + packed<std::uint32_t>({58, 0, 54, 40, 1, 1, 0x180001, 0, 4, 0, 0, 0, 0}) +
                          std::string("\x10\x20\xf0\0", 4);
  const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0", 18) + "\x10\x20\xf0";
  const std::string gif = std::string("GIF89a\1\0\1\0\x80\0\0\xf0\x20\x10\0\0\0,\0\0\0\0\1\0\1\0\0\2\2D\1\0;", 35);
  const auto entry = [](std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
    return packed<std::uint16_t>({tag, type}) + packed<std::uint32_t>({count, value});
  };
  std::string tiff = "II" + packed<std::uint16_t>({42}) + packed<std::uint32_t>({8}) + packed<std::uint16_t>({9});
  tiff += entry(256, 3, 1, 1) + entry(257, 3, 1, 1) + entry(258, 3, 1, 8) + entry(259, 3, 1, 1) + entry(262, 3, 1, 2) +
          entry(273, 4, 1, 122) + entry(277, 3, 1, 3) + entry(278, 3, 1, 1) + entry(279, 4, 1, 3) +
          packed<std::uint32_t>({0}) + "\xf0\x20\x10";
  for (const auto& [name, contents] : {std::pair("t.bmp", bmp), std::pair("t.tga", tga), std::pair("t.gif", gif),
                                       std::pair("t.tif", tiff), std::pair("t.png", bmp)}) {
    INFO(name);
    Case one;
    one.write(std::string("thing/") + name, contents);
    check_colour(one.read_square(std::string("newmtl paint\nmap_Kd ") + name + "\n"), 240, 32, 16);
    one.write(std::string("thing/") + name, contents.substr(0, 12));
    one.write("thing/a.obj", kSquare);
    CHECK_THAT(one.refusal(), Catch::Contains(": texture ") && Catch::Contains(name) && Catch::Contains("damaged"));
  }
  Case none;
  none.write("thing/t.dat", "no image");
  none.write("thing/a.mtl", "newmtl paint\nmap_Kd t.dat\n");
  none.write("thing/a.obj", kSquare);
  CHECK_THAT(none.refusal(),
             Catch::EndsWith("t.dat: is no image of a known kind (PNG, JPEG, WebP, BMP, TGA, TIFF or GIF)"));
}

TEST_CASE("a georeferenced scan is centred before it loses its detail to 32 bits") {
  Case one;
  one.write(
      "thing/a.obj",
      "v 500000.000 4500000.000 100\nv 500000.012 4500000.000 100\nv 500000.012 4500000.008 100\nv 500000 4500000 "
      "100.005\nf 1 2 3\nf 1 3 4\nf 1 2 4\nf 2 3 4\n");
  Eigen::AlignedBox3f box;
  for (const Vec3& point : one.read().points) box.extend(point);
  CHECK(box.sizes().isApprox(Vec3(0.012f, 0.008f, 0.005f), 1e-5f));
  CHECK(box.center().norm() < 1e-6f);
}

TEST_CASE("OBJ: negative indices, continued lines, polygons, points that no face uses") {
  Case one;
  one.write("thing/a.obj",
            "v 9 9 9\nv 0 0 0\nv 2 0 0\nv 2 2 0\n# the notch\nv 1 0.5 0\nv 0 2 0\nf -5 \\\n -4 -3 -2 -1\nl 1 2\np 1\n");
  const Mesh mesh = one.read();
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.triangles.size() == 3);
  float area = 0;
  for (const auto& triangle : mesh.triangles)
    area += (mesh.points[triangle.corner[1]] - mesh.points[triangle.corner[0]])
                .cross(mesh.points[triangle.corner[2]] - mesh.points[triangle.corner[0]])
                .z() /
            2;
  CHECK(area == Approx(2.5));
  one.write("thing/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  CHECK_THAT(one.refusal(), Catch::EndsWith("a.obj: line 4: a corner is at point 9 of 3"));
  one.write("thing/a.obj", "v 0 0 0\nv 1 x 0\n");
  CHECK_THAT(one.refusal(), Catch::EndsWith("a.obj: line 2: 'x' is not a number"));
}

TEST_CASE("OBJ: colours after the coordinates are those of the vertices") {
  Case one;
  one.write("thing/a.obj", "v 0 0 0 1 0.5 0\nv 1 0 0 1 0.5 0\nv 0 1 0 1 0.5 0\nf 1 2 3\n");
  check_colour(one.read(), 255, 128, 0);
  // Levels: one above 1 tells it of all, wherever it stands.
  one.write("thing/a.obj", "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\nv 5 5 5 9 200 3\n");
  check_colour(one.read(), 1, 1, 1);
  one.write("thing/a.obj", "v 0 0 0 1 1 1\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\nv 5 5 5 255\n");
  check_colour(one.read(), 255, 255, 255);
}

TEST_CASE("OBJ and MTL may begin with a byte order mark") {
  Case one;
  one.write("thing/a.mtl", "\xef\xbb\xbfnewmtl paint\nKd 1 0 0\n");
  one.write("thing/a.obj", "\xef\xbb\xbfmtllib a.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  check_colour(one.read(), 255, 0, 0);
  one.write("thing/a.obj", "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(one.read().triangles.size() == 1);
}
