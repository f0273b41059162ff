// svnet-render --meshes on collections as people have them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "io/views/dataset_folder.h"
#include "shell.h"

using namespace svnet;
using namespace svnet::io;

namespace {

/// A box of these edges, with a material of the file a.mtl.
std::string box(double length, double width, double height, const std::string& head = "") {
  std::string text = head;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(length * (i & 1)) + " " + std::to_string(width * (i >> 1 & 1)) + " " +
            std::to_string(height * (i >> 2)) + "\n";
  return text +
         "vt 0 0\nf 1/1 3/1 4/1 2/1\nf 5/1 6/1 8/1 7/1\nf 1/1 2/1 6/1 5/1\nf 3/1 7/1 8/1 4/1\nf 1/1 5/1 7/1 3/1\nf "
         "2/1 4/1 8/1 6/1\n";
}

Ran collect(const TemporaryFolder& folder, const std::string& more = "") {
  return run_shell(folder.path(), SVNET_RENDER " --poses 1 --size 32 --meshes meshes --output d " + more);
}

/// The lines of stderr but for the progress.
std::vector<std::string> lines(const Ran& ran) {
  std::vector<std::string> result;
  std::istringstream text(ran.err);
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("poses: ")) result.push_back(line);
  return result;
}

nlohmann::json manifest(const TemporaryFolder& folder) {
  return nlohmann::json::parse(file_contents(folder.path() / "d/manifest.json"));
}

}  // namespace

TEST_CASE("one bad mesh, one without its texture and one in another unit cost eleven objects of twelve nothing", "[slow]") {
  const TemporaryFolder folder;
  for (int i = 1; i <= 9; ++i) folder.write("meshes/box/good" + std::to_string(i) + ".obj", box(0.08, 0.06, 0.05));
  folder.write("meshes/box/broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  folder.write("meshes/box/cm.obj", box(8, 6, 5));
  folder.write("meshes/box/plain.obj", box(0.08, 0.06, 0.05, "mtllib plain.mtl\nusemtl paint\n"));
  folder.write("meshes/box/plain.mtl", "newmtl paint\nKd 1 0 0\nmap_Kd gone.png\n");
  const Ran ran = collect(folder);
  CHECK(ran.status == 0);
  CHECK(lines(ran) == std::vector<std::string>{
                          "left out: meshes/box/broken.obj: line 3: a corner is at point 3 of 2",
                          "meshes/box/cm.obj: is 8 units long, taken as centimetres: 0.08 m (--unit decides otherwise)",
                          "meshes/box/plain.obj: texture 'gone.png' is missing; the object is rendered without it"});
  CHECK_THAT(ran.out, Catch::EndsWith(" images of 11 poses in d; 1 of 12 objects left out (box/broken), as "
                                      "manifest.json tells\n"));
  const auto json = manifest(folder);
  CHECK(json.at("poses").at("box").size() == 11);
  CHECK(json.at("left_out").at("box").at("broken").at("1") == "box/broken.obj: line 3: a corner is at point 3 of 2");
  CHECK(json.at("poses").at("box").at("cm").at("1").at("length_m") == Approx(0.08).margin(0.005));
  CHECK(read_view_dataset(folder.path() / "d").poses.size() == 11);
}

TEST_CASE("the option --unit decides for all meshes, and only a collection of nothing fails") {
  const TemporaryFolder folder;
  folder.write("meshes/box/cm.obj", box(8, 6, 5));
  folder.write("meshes/box/m.obj", box(0.08, 0.06, 0.05));
  const Ran ran = collect(folder, "--unit 0.01");
  CHECK(ran.status == 0);
  CHECK(manifest(folder).at("poses").at("box").contains("cm"));
  CHECK_THAT(ran.err, Catch::Contains("left out: meshes/box/m.obj: is 0.8 mm long"));
  std::filesystem::remove_all(folder.path() / "d");
  const Ran none = collect(folder, "--unit 100 --quiet");
  CHECK(none.status == 1);
  CHECK(none.err ==
        "svnet-render: meshes/box/cm.obj: is 800 m long, objects may be 1 mm to 1 m; is its unit right? With "
        "--unit 0.01 it would be 0.08 m.; none of the 2 objects was collected\n");
  CHECK_FALSE(std::filesystem::exists(folder.path() / "d"));
}

TEST_CASE("an object may have a folder of its own") {
  const TemporaryFolder folder;
  const std::string brick = box(0.08, 0.06, 0.05);
  folder.write("meshes/box/plain.obj", brick);
  folder.write("meshes/box/ycb/google_16k/textured.obj", brick);
  folder.write("meshes/box/ycb/google_16k/nontextured.stl", "");
  folder.write("meshes/box/ycb/tsdf/textured.obj", "");
  folder.write("meshes/box/scan/meshes/model.obj", brick);
  folder.write("meshes/box/scan/meshes/model_collision.obj", "");
  folder.write("meshes/box/textures/wood.txt", "");
  const Ran ran = collect(folder);
  CHECK(ran.status == 0);
  CHECK(lines(ran) == std::vector<std::string>{
                          "meshes/box/ycb: holds 2 such meshes; meshes/box/ycb/google_16k/textured.obj is taken"});
  const auto json = manifest(folder);
  CHECK(json.at("poses").at("box").size() == 3);
  for (const char* name : {"plain", "ycb", "scan"}) CHECK(json.at("poses").at("box").contains(name));
}
