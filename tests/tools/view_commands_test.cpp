#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/images/image_file.h"
#include "io/views/dataset_folder.h"
#include "shell.h"

using namespace svnet;
using namespace svnet::io;

namespace {

Ran run(const TemporaryFolder& folder, const std::string& command) { return run_shell(folder.path(), command); }

std::map<std::string, std::string> contents(const std::filesystem::path& root) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(root)] = file_contents(entry.path());
  return files;
}

constexpr const char* kRender = SVNET_RENDER " --quiet --categories mug,key --objects 1 --poses 2 --size 32 ";

}  // namespace

TEST_CASE("svnet-render writes a dataset, the same for any number of threads", "[slow]") {
  const TemporaryFolder folder;
  REQUIRE(run(folder, std::string(kRender) + "--threads 1 --output one").status == 0);
  REQUIRE(run(folder, std::string(kRender) + "--threads 3 --output three/").status == 0);
  REQUIRE(run(folder, std::string(kRender) + "--seed 2 --output other").status == 0);
  const auto files = contents(folder.path() / "one");
  CHECK(contents(folder.path() / "three") == files);
  CHECK(contents(folder.path() / "other") != files);

  const ViewDataset dataset = read_view_dataset(folder.path() / "one");
  CHECK(dataset.categories == std::vector<std::string>{"key", "mug"});
  REQUIRE(dataset.poses.size() == 4);
  for (const auto& pose : dataset.poses) {
    CHECK(pose.view_count >= 17);
    CHECK(pose.view_count <= 22);
  }
  const auto manifest = nlohmann::json::parse(files.at("manifest.json"));
  CHECK(manifest.at("poses").at("mug").at("1").at("2").at("views").size() ==
        static_cast<std::size_t>(dataset.poses[3].view_count));
  for (const char* name : {"_extra/mug/1/1/overview.png", "_extra/mug/1/1/overview_depth.png",
                           "_extra/mug/1/1/90_90_mask.png", "_extra/mug/1/1/90_90_depth.png",
                           "_extra/overview_camera.json", "_extra/view_camera.json", "_extra/contact_sheet.png"})
    CHECK(files.count(name) == 1);
  CHECK(read_image(folder.path() / "one/mug/1/1/90_90.png").width == 32);
  CHECK(read_image(folder.path() / "one/_extra/contact_sheet.png").height == 2 * 98 + 2);  // one row per category

  const Ran again = run(folder, std::string(kRender) + "--output one");
  CHECK(again.status == 1);
  CHECK(again.err == "svnet-render: one: exists already, remove it or choose another folder\n");
  CHECK(run(folder, SVNET_RENDER " --output x --categories mugg").err ==
        "svnet-render: there is no category 'mugg', did you mean 'mug'?\n");
  CHECK_FALSE(std::filesystem::exists(folder.path() / "x"));
}

namespace {

std::string box(int length, int width, int height) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(length * (i & 1)) + " " + std::to_string(width * (i >> 1 & 1)) + " " +
            std::to_string(height * (i >> 2)) + "\n";
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

}  // namespace

TEST_CASE("svnet-render leaves out a pose that cannot be collected, and says so") {
  const TemporaryFolder folder;
  folder.write("meshes/box/brick.obj", box(80, 60, 50));
  folder.write("meshes/box/crumb.obj", box(1, 1, 1));  // smaller than a pixel of the overview
  const std::string options = SVNET_RENDER " --unit 0.001 --poses 1 --size 32 ";
  const Ran ran = run(folder, options + "--meshes meshes --output d");
  REQUIRE(ran.status == 0);
  const std::string problem = "not collected in 16 tries: [localise] nothing is found";
  CHECK_THAT(ran.err, Catch::Contains("left out: box/crumb/1: " + problem));
  CHECK_THAT(ran.out, Catch::Contains(" images of 1 poses in d; 1 left out, as manifest.json tells\n"));
  const auto manifest = nlohmann::json::parse(file_contents(folder.path() / "d/manifest.json"));
  CHECK_THAT(manifest.at("left_out").at("box").at("crumb").at("1").get<std::string>(), Catch::StartsWith(problem));
  CHECK(manifest.at("poses").at("box").size() == 1);
  const ViewDataset dataset = read_view_dataset(folder.path() / "d");
  REQUIRE(dataset.poses.size() == 1);

  std::filesystem::remove(folder.path() / "meshes/box/brick.obj");
  CHECK_THAT(run(folder, options + "--quiet --meshes meshes --output e").err,
             Catch::StartsWith("svnet-render: no pose was collected; the first, box/crumb/1: " + problem));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "e"));
}

TEST_CASE("svnet-render reads the user's meshes") {
  const TemporaryFolder folder;
  folder.write("meshes/box/brick.obj", box(80, 60, 50));
  REQUIRE(run(folder, SVNET_RENDER " --quiet --output d --meshes meshes --unit 0.001 --poses 1 --size 32").status == 0);
  const auto manifest = nlohmann::json::parse(file_contents(folder.path() / "d/manifest.json"));
  const auto& pose = manifest.at("poses").at("box").at("brick").at("1");
  CHECK(pose.at("length_m") == Approx(0.08).margin(0.005));
  CHECK(pose.at("width_m") == Approx(0.06).margin(0.005));
  CHECK(pose.at("height_m") == Approx(0.05).margin(0.005));

  folder.write("bad/box/brick.obj", "v 0 0 0\n");
  const Ran bad = run(folder, SVNET_RENDER " --quiet --output e --meshes bad");
  CHECK(bad.status == 1);
  CHECK_THAT(bad.err, Catch::StartsWith("svnet-render: bad/box/brick.obj: "));
  CHECK(std::count(bad.err.begin(), bad.err.end(), '\n') == 1);
  CHECK_THAT(run(folder, SVNET_RENDER " --quiet --output e --meshes none").err, Catch::Contains("none: "));
}

TEST_CASE("svnet-render says which objects it cannot use") {
  const TemporaryFolder folder;
  folder.write("meshes/box/brick.obj", box(80, 60, 50));
  folder.write("meshes/textures/wood.txt", "");
  folder.write("meshes/_old/brick.obj", "");
  folder.write("meshes/box/._brick.obj", "");
  const std::string options = SVNET_RENDER " --poses 1 --size 32 --output d --meshes meshes --unit ";
  const auto error_of = [&](const std::string& arguments) {
    const Ran ran = run(folder, options + arguments);
    CHECK(ran.status == 1);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "d"));
    return ran.err;
  };
  CHECK(run(folder, SVNET_RENDER " --output d --categories mug,key,mug").err ==
        "svnet-render: the category 'mug' is given twice\n");
  CHECK_THAT(error_of("0.001 --categories box,boxes"),
             Catch::EndsWith("svnet-render: there is no category 'boxes' in meshes, did you mean 'box'?\n"));
  CHECK_THAT(
      error_of("0.001 --categories textures"),
      Catch::EndsWith("svnet-render: meshes/textures: holds no meshes; expected NAME.obj, .ply, .stl or .glb\n"));
  CHECK_THAT(
      error_of("1"),
      Catch::EndsWith("svnet-render: meshes/box/brick.obj: is 80 m long, objects may be 1 mm to 1 m; is its unit "
                      "right? With --unit 0.001 it would be 0.08 m.\n"));
  CHECK_THAT(error_of("0.000001"), Catch::Contains("brick.obj: is 0.08 mm long"));

  const Ran ran = run(folder, options + "0.001");
  CHECK(ran.status == 0);
  const std::string ignored = ": names that begin with '_' or '.' are ignored in data sets\n";
  CHECK_THAT(ran.err, Catch::Contains("left out: meshes/_old" + ignored));
  CHECK_THAT(ran.err, Catch::Contains("left out: meshes/box/._brick.obj" + ignored));
  std::filesystem::remove_all(folder.path() / "d");

  folder.write("meshes/box/brick.STL", "");
  CHECK_THAT(error_of("0.001"), Catch::EndsWith("svnet-render: meshes/box/brick.STL and meshes/box/brick.obj: both are "
                                                "the object 'brick'; rename one of them\n"));
}

TEST_CASE("svnet-render refuses numbers out of range") {
  const TemporaryFolder folder;
  for (const auto& [option, problem] :
       {std::pair("--seed -1", "--seed: Value -1 not in range 0 to 9007199254740992"),
        std::pair("--seed 12345678901234567890123",
                  "--seed: Value 12345678901234567890123 not in range 0 to 9007199254740992"),
        std::pair("--meshes m --unit 0", "--unit: 0 is out of range, must be greater than 0"),
        std::pair("--meshes m --unit nan", "--unit: nan is out of range, must be greater than 0")}) {
    const Ran ran = run(folder, std::string(kRender) + "--output d " + option);
    CHECK(ran.status == 2);
    CHECK(ran.err == "svnet-render: " + std::string(problem) + "; see svnet-render --help\n");
  }
}

TEST_CASE("svnet-views localises an object and prints camera poses") {
  const TemporaryFolder folder;
  REQUIRE(run(folder, std::string(kRender) + "--output d").status == 0);
  const std::string extra = "d/_extra/mug/1/1/";
  const std::string images = " d/_extra/overview_camera.json --background " + extra + "overview_background.png " +
                             extra + "overview_background_depth.png --current " + extra + "overview.png " + extra +
                             "overview_depth.png ";
  REQUIRE(run(folder, SVNET_VIEWS + images + "--json v.json --csv v.csv --plot v.png --steps steps").status == 0);
  const auto json = nlohmann::json::parse(file_contents(folder.path() / "v.json"));
  const auto manifest = nlohmann::json::parse(file_contents(folder.path() / "d/manifest.json"));
  CHECK(json.at("object").at("length_m") == manifest.at("poses").at("mug").at("1").at("1").at("length_m"));
  CHECK(json.at("views").size() == 22);
  CHECK(read_image(folder.path() / "v.png").width == 512);
  for (const char* step : {"difference", "foreground", "contour", "height"})
    CHECK(read_image(folder.path() / "steps" / (std::string(step) + ".png")).width == 640);
  // The images of the steps never overwrite an input.
  std::filesystem::copy_file(folder.path() / (extra + "overview.png"), folder.path() / "contour.png");
  CHECK(run(folder, SVNET_VIEWS " d/_extra/overview_camera.json --background " + extra + "overview_background.png " +
                        extra + "overview_background_depth.png --current contour.png " + extra +
                        "overview_depth.png --steps .")
            .err ==
        "svnet-views: ./contour.png: cannot be written: the command needs this file for something else; "
        "give another name\n");
  std::istringstream csv(file_contents(folder.path() / "v.csv"));
  std::string line;
  std::getline(csv, line);
  CHECK(line == "theta,phi,theta_rad,phi_rad,x_m,y_m,z_m,qx,qy,qz,qw");
  std::getline(csv, line);
  CHECK(line.substr(0, 5) == "0,45,");

  folder.write("camera.json", R"({"width": 100, "height": 100, "fx": 140, "fy": 140, "cx": 50, "cy": 50})");
  folder.write("reach.csv", "theta,phi\n0,45\n90,90\n");
  const Ran ran = run(folder, SVNET_VIEWS " camera.json --centre 1 2 3 --diagonal 0.5 --reachable reach.csv");
  CHECK(ran.status == 0);
  CHECK_THAT(ran.out, Catch::Contains("\n90,90,"));
  CHECK(std::count(ran.out.begin(), ran.out.end(), '\n') == 3);
  const auto top = ran.out.substr(ran.out.find("\n90,90,"));
  CHECK_THAT(top, Catch::Contains(",2,4,"));  // 1 m above the centre
}

TEST_CASE("svnet-views says what is wrong") {
  const TemporaryFolder folder;
  folder.write("camera.json", R"({"width": 100, "height": 100, "fx": 140, "fy": 140, "cx": 50, "cy": 50})");
  folder.write("reach.csv", "theta,phi\n270,10\n");
  CHECK(run(folder, SVNET_VIEWS " camera.json").status == 2);
  CHECK(run(folder, SVNET_VIEWS " camera.json --centre 1 2 3").status == 2);
  CHECK(run(folder, SVNET_VIEWS " camera.json --centre 1 2 3 --diagonal nan").status == 2);
  CHECK(run(folder, SVNET_VIEWS " camera.json --centre 1 2 3 --diagonal 0.5 --reachable reach.csv").err ==
        "svnet-views: reach.csv: none of the 22 poses is reachable\n");
  CHECK_THAT(run(folder, SVNET_VIEWS " none.json --centre 1 2 3 --diagonal 0.5").err,
             Catch::Contains("none.json: cannot be read"));
  CHECK(run(folder, SVNET_VIEWS " camera.json --background a b --current c d").err ==
        "svnet-views: camera.json: the key 'pose' is missing, where the camera was for the images\n");
}

TEST_CASE("svnet-views takes a ROS camera, and CSV to standard output") {
  const TemporaryFolder folder;
  folder.write("plain.json", R"({"width": 640, "height": 480, "fx": 600, "fy": 600, "cx": 319.5, "cy": 239.5})");
  folder.write("ros.yaml",
               "width: 640\nheight: 480\nD: [0.0, 0.0, 0.0, 0.0, 0.0]\n"
               "K: [600.0, 0.0, 319.5, 0.0, 600.0, 239.5, 0.0, 0.0, 1.0]\n");
  const std::string object = " --centre 0 0 0.05 --diagonal 0.2";
  const Ran plain = run(folder, SVNET_VIEWS " plain.json" + object);
  REQUIRE(plain.status == 0);
  CHECK(run(folder, SVNET_VIEWS " ros.yaml" + object).out == plain.out);
  CHECK(run(folder, SVNET_VIEWS " ros.yaml" + object + " --csv /dev/stdout | cat").out == plain.out);
  CHECK(run(folder, SVNET_VIEWS " plain.json" + object + " --depth-unit mm").status == 2);
}
