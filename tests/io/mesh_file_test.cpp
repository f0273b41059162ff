#include "io/mesh_file.h"

#include <catch2/catch.hpp>

#include "io/image_file.h"
#include "temporary_folder.h"

using namespace svnet;

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
  const Mesh mesh = read_mesh(path, 0.001);
  REQUIRE(mesh.triangles.size() == 2);
  CHECK(mesh.points[mesh.triangles[0].corner[1]].maxCoeff() == Approx(0.002));
  CHECK(mesh.normals[0][0].isApprox(Vec3(0, 0, 1)));
  const Material& material = mesh.materials[static_cast<std::size_t>(mesh.triangles[0].material)];
  CHECK(material.colour.isApprox(Vec3(0.25f, 0.5f, 0.75f)));
  CHECK(material.texture == Texture::picture);
  REQUIRE(mesh.pictures.size() == 1);
  CHECK(mesh.pictures[0].width == 2);
  REQUIRE(mesh.uv.size() == 2);
  CHECK(mesh.uv[0][1].x() == Approx(1));

  CHECK(read_mesh(folder.write("a.stl", kStl)).triangles.size() == 1);
  CHECK(read_mesh(folder.write("a.ply", kPly)).triangles.size() == 1);
}

TEST_CASE("meshes that cannot be read get one line that names them") {
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
  CHECK(refusal(path) == in("paint.png") + ": no such file");
  folder.write("paint.png", "no picture");
  CHECK_THAT(refusal(path), Catch::StartsWith(in("paint.png") + ": is not a PNG"));
  const std::string text = kPly;
  CHECK_THAT(refusal(folder.write("f.ply", text.substr(0, text.find("1 0 0")) + "nan 0 0\n0 1 0\n3 0 1 2\n")),
             Catch::StartsWith(in("f.ply") + ": "));
}
