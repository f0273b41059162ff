// Installs the library, moves it, builds an outside project against it, and compares the scores of
// the command, the C program, the C++ program and the Python module.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/environment.h"
#include "io/images/image_file.h"
#include "io/models/backbone_file.h"
#include "io/views/dataset_folder.h"
#include "shared_folder.h"
#include "small_model.h"
#include "temporary_folder.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using namespace svnet::view;
namespace fs = std::filesystem;

namespace {

/// Returns the output of a shell command. Requires success.
std::string output_of(const TemporaryFolder& folder, const std::string& command) {
  const fs::path log = folder.path() / "log";
  const int status = std::system((command + " >" + log.string() + " 2>&1").c_str());
  const std::string output = file_contents(log);
  INFO(command << "\n" << output);
  REQUIRE(status == 0);
  return output;
}

/// Installs the library and what programs need to be built with it; not the commands.
void install_library(const TemporaryFolder& folder, const fs::path& prefix) {
  for (const std::string component : {"library", "development"})
    output_of(folder, CMAKE " --install " BUILD_FOLDER " --prefix " + prefix.string() + " --component " + component);
}

/// The contents of a PPM file, the format that the programs of the project read.
std::string ppm(const Image& image) {
  return joined("P6 ", image.width, " ", image.height, " 255\n") + std::string(image.rgb.begin(), image.rgb.end());
}

/// Builds the project against the library that was installed at `prefix`, and returns the folder of its programs.
std::string built_project(const TemporaryFolder& folder, const fs::path& prefix) {
  const std::string build = folder.path() / "build";
  output_of(folder, CMAKE " -S " CONSUMER_PROJECT " -B " + build + " -DCMAKE_PREFIX_PATH='" + prefix.string() +
                        "' -DCMAKE_C_COMPILER=" C_COMPILER " -DCMAKE_CXX_COMPILER=" CXX_COMPILER
                        " -DCMAKE_C_FLAGS='" SANITIZER_FLAG "' -DCMAKE_CXX_FLAGS='" SANITIZER_FLAG "'");
  output_of(folder, CMAKE " --build " + build);
  return build;
}

/// Command lines that take MODEL IMAGE.ppm THETA PHI… and print the scores and the index of the best.
std::vector<std::string> programs(const std::string& build) {
  std::vector<std::string> commands{build + "/score_c", build + "/score_cpp"};
  if (const std::string python = PYTHON; !python.empty()) commands.push_back(python + " " CONSUMER_PROJECT "/score.py");
  return commands;
}

/// Checks that the programs give svnet-predict's scores for an image, to 1e-6, and the same best view. Returns the
/// largest difference.
double compare(const TemporaryFolder& folder, const std::vector<std::string>& commands, const std::string& model,
               const fs::path& image, const std::vector<CameraPose>& poses) {
  std::string csv = "theta,phi\n",
              arguments = " " + model + " " + folder.write("top.ppm", ppm(read_image(image))).string();
  for (const CameraPose& pose : poses) {
    csv += joined(pose.theta_deg, ",", pose.phi_deg, "\n");
    arguments += joined(" ", pose.theta_deg, " ", pose.phi_deg);
  }
  const auto expected =
      nlohmann::json::parse(output_of(folder, SVNET_PREDICT " " + model + " --image '" + image.string() +
                                                  "' --json --poses " + folder.write("poses.csv", csv).string()));
  std::map<std::pair<double, double>, double> score_of;
  for (const auto& view : expected.at("views"))
    score_of[{view.at("theta_deg").get<double>(), view.at("phi_deg").get<double>()}] = view.at("score").get<double>();
  REQUIRE(score_of.size() == poses.size());
  double largest = 0;
  for (const std::string& command : commands) {
    INFO(command << " " << image);
    std::istringstream lines(output_of(folder, command + arguments));
    for (const CameraPose& pose : poses) {
      double score = -1;
      REQUIRE(lines >> score);
      largest = std::max(largest, std::abs(score - score_of.at({pose.theta_deg, pose.phi_deg})));
      CHECK(largest <= 1e-6);
    }
    std::size_t best = poses.size();
    REQUIRE(lines >> best);
    REQUIRE(best < poses.size());
    CHECK(poses[best].theta_deg == expected.at("best").at("theta_deg"));
    CHECK(poses[best].phi_deg == expected.at("best").at("phi_deg"));
  }
  return largest;
}

/// SV-net as configs/eth80.yaml describes it, on MobileNet's weights; its head has random weights.
Model eth80_model(const fs::path& weights) {
  const Backbone backbone = read_backbone("mobilenet", weights, "", nullptr);
  Model model{.backbone = "mobilenet",
              .backbone_output = backbone.output_name(),
              .preprocessing = backbone.preprocessing(),
              .backbone_graph = backbone.graph(),
              .backbone_parameters = backbone.parameters(),
              .angles = AngleEncoding::radians,
              .head = sv_net({.features = backbone.dimension(), .width = 1024, .angles = AngleEncoding::radians}),
              .head_parameters = {},
              .input_fingerprint = "eth80"};
  model.head_parameters = initial_parameters(model.head, 4);
  return model;
}

}  // namespace

TEST_CASE("an outside project finds the installed library after a move, and gets svnet-predict's scores") {
  const TemporaryFolder folder;
  const fs::path first = folder.path() / "first", prefix = folder.path() / "moved" / "to a place";
  install_library(folder, first);
  fs::create_directories(prefix.parent_path());
  fs::rename(first, prefix);

  // Only the public headers, the library, the package, and documentation of Debian's packages.
  std::vector<std::string> headers;
  for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
    if (entry.is_directory()) continue;
    const std::string path = entry.path().lexically_relative(prefix).string();
    if (path.rfind("share/doc/", 0) == 0) continue;
    INFO(path);
    if (path.rfind("include/", 0) == 0)
      headers.push_back(path);
    else
      CHECK((path.rfind(LIBRARY_FOLDER "/libsvnet.so", 0) == 0 || path.rfind(LIBRARY_FOLDER "/cmake/svnet/", 0) == 0 ||
             path == LIBRARY_FOLDER "/libsvnet.a" || path == LIBRARY_FOLDER "/pkgconfig/svnet.pc"));
    if (entry.path().extension() == ".cmake" || entry.path().extension() == ".pc") {
      CHECK_THAT(file_contents(entry.path()), !Catch::Contains(BUILD_FOLDER));
      CHECK_THAT(file_contents(entry.path()), !Catch::Contains(first.string()));
    }
  }
  std::sort(headers.begin(), headers.end());
  CHECK(headers == std::vector<std::string>{"include/svnet/svnet.h", "include/svnet/svnet.hpp"});

  const std::string build = built_project(folder, prefix);
  const std::string model = folder.path() / "model.safetensors", image = folder.path() / "top.png";
  write_model(model, small_model());
  for (const auto& [height, width] : {std::pair<Index, Index>{70, 50}, {32, 32}, {33, 200}}) {
    write_png(image, small_image(height, width));
    compare(folder, programs(build), model, image, paper_grid());
  }

  // Linked from its new place, and without the libraries of training and of the commands.
  std::string libraries = output_of(folder, "ldd " + build + "/score_c");
  CHECK_THAT(libraries, Catch::Contains(prefix.string() + "/" LIBRARY_FOLDER "/libsvnet.so.0"));
  std::transform(libraries.begin(), libraries.end(), libraries.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* name : {"blas", "opencv", "hdf5", "yaml", "libpng", "jpeg", "webp", "not found"}) {
    INFO(name);
    CHECK_THAT(libraries, !Catch::Contains(name));
  }
  for (std::istringstream symbols(
           output_of(folder, "nm -D --defined-only '" + prefix.string() + "/" LIBRARY_FOLDER "/libsvnet.so'"));
       symbols;) {
    std::string address, kind, name;
    if (symbols >> address >> kind >> name) CHECK_THAT(name, Catch::StartsWith("svnet_"));
  }
}

TEST_CASE("pkg-config, the static library and the components of find_package") {
  const TemporaryFolder folder;
  const fs::path first = folder.path() / "first", prefix = folder.path() / "moved";
  install_library(folder, first);
  fs::rename(first, prefix);
  const std::string model = folder.path() / "model.safetensors", image = folder.path() / "top.png";
  write_model(model, small_model());
  write_png(image, small_image(32, 32));
  const std::string pkg_config =
      "PKG_CONFIG_PATH=" + prefix.string() + "/" LIBRARY_FOLDER "/pkgconfig pkg-config --print-errors ";
  CHECK_THAT(output_of(folder, pkg_config + "--modversion svnet"), Catch::StartsWith("0."));

  // By pkg-config, shared and static, in C: no flag but pkg-config's.
  const std::string compile =
      C_COMPILER " -std=c99 " SANITIZER_FLAG " " CONSUMER_PROJECT "/score.c -o " + folder.path().string();
  const std::string library_folder = prefix.string() + "/" LIBRARY_FOLDER;
  output_of(folder, compile + "/score_shared $(" + pkg_config + "--cflags --libs svnet) -Wl,-rpath," + library_folder);
  output_of(folder, "mkdir " + folder.path().string() + "/only && cp " + library_folder + "/libsvnet.a " +
                        folder.path().string() + "/only");
  output_of(folder, compile + "/score_static -L" + folder.path().string() + "/only $(" + pkg_config +
                        "--static --cflags --libs svnet)");
  // By CMake.
  const auto configure = [&](const std::string& components, const std::string& rest) {
    const std::string source = "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES C CXX)\nfind_package(svnet " +
                               components + ")\n" + rest;
    folder.write("project/CMakeLists.txt", source);
    return std::string(CMAKE " -S ") + folder.path().string() + "/project -B " + folder.path().string() +
           "/built -DCMAKE_PREFIX_PATH='" + prefix.string() +
           "' -DCMAKE_C_COMPILER=" C_COMPILER " -DCMAKE_CXX_COMPILER=" CXX_COMPILER " -DCMAKE_C_FLAGS='" SANITIZER_FLAG
           "' -DCMAKE_CXX_FLAGS='" SANITIZER_FLAG "'";
  };
  output_of(folder, configure("REQUIRED COMPONENTS static", "add_executable(score_cmake " CONSUMER_PROJECT
                                                            "/score.c)\ntarget_link_libraries(score_cmake PRIVATE "
                                                            "svnet::svnet_static)\n") +
                        " && " CMAKE " --build " + folder.path().string() + "/built");
  const std::string folder_name = folder.path().string();
  compare(folder, {folder_name + "/score_shared", folder_name + "/score_static", folder_name + "/built/score_cmake"},
          model, image, paper_grid());
  for (const std::string program : {"/score_static", "/built/score_cmake"})
    CHECK_THAT(output_of(folder, "ldd " + folder_name + program), !Catch::Contains("libsvnet"));
  CHECK_THAT(output_of(folder, "ldd " + folder_name + "/score_shared"), Catch::Contains("libsvnet.so"));

  CHECK_THAT(output_of(folder, "! " + configure("REQUIRED COMPONENTS x", "")),
             Catch::Contains("svnet has no component 'x'; it has: shared, static"));
  output_of(folder, configure("QUIET COMPONENTS x", "if(svnet_FOUND)\nmessage(FATAL_ERROR found)\nendif()\n"));
  output_of(folder, configure("REQUIRED COMPONENTS shared OPTIONAL_COMPONENTS x", ""));
}

// SVNET_ETH80_MODEL may name a model that svnet-train wrote; without it the head has random weights.
TEST_CASE("photographs: command, C, C++ and Python agree on the scores of 20 images and 41 poses") {
  const fs::path weights = shared_folder("weights/mobilenet_1_0_224_tf_no_top.h5"), data = shared_folder("data/eth80");
  if (!fs::exists(weights) || !fs::exists(data)) {
    WARN("skipped: no " << weights << " or no " << data);
    return;
  }
  const TemporaryFolder folder;
  const fs::path prefix = folder.path() / "prefix";
  install_library(folder, prefix);
  const std::vector<std::string> commands = programs(built_project(folder, prefix));
  const std::string trained = environment_variable("SVNET_ETH80_MODEL");
  const std::string model = !trained.empty() ? trained : (folder.path() / "model.safetensors").string();
  if (trained.empty()) write_model(model, eth80_model(weights));

  const ViewDataset dataset = read_view_dataset(data);
  REQUIRE(dataset.poses.size() >= 20);
  double largest = 0;
  for (std::size_t image = 0; image < 20; ++image) {
    const ViewDataset::Pose& object = dataset.poses[image * dataset.poses.size() / 20];
    std::vector<CameraPose> poses;
    for (Index v = object.first_view; v < object.first_view + object.view_count; ++v)
      poses.push_back({static_cast<double>(dataset.views[static_cast<std::size_t>(v)].theta_deg),
                       static_cast<double>(dataset.views[static_cast<std::size_t>(v)].phi_deg)});
    REQUIRE(poses.size() == 41);
    const View& top = dataset.views[static_cast<std::size_t>(object.top_view)];
    largest = std::max(largest, compare(folder, commands, model, data / top.path, poses));
  }
  std::cout << "largest difference: " << largest << "\n";
}
