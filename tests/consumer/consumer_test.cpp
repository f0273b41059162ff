// Installs the library, moves what was installed, and builds and runs a project of its own against it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/image_file.h"
#include "predict/pose_grid.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
namespace fs = std::filesystem;

namespace {

/// What a shell command prints; it must succeed.
std::string output_of(const TemporaryFolder& folder, const std::string& command) {
  const fs::path log = folder.path() / "log";
  const int status = std::system((command + " >" + log.string() + " 2>&1").c_str());
  const std::string output = file_contents(log);
  INFO(command << "\n" << output);
  REQUIRE(status == 0);
  return output;
}

std::string ppm(const Image& image) {
  return joined("P6 ", image.width, " ", image.height, " 255\n") + std::string(image.rgb.begin(), image.rgb.end());
}

}  // namespace

TEST_CASE("an outside project finds the installed library, wherever it was moved, and gets svnet-predict's scores") {
  const TemporaryFolder folder;
  const fs::path first = folder.path() / "first", prefix = folder.path() / "moved" / "to a place";
  output_of(folder, CMAKE " --install " BUILD_FOLDER " --prefix " + first.string());
  fs::create_directories(prefix.parent_path());
  fs::rename(first, prefix);

  // Only the public headers, the library and the package.
  std::vector<std::string> headers;
  for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
    if (entry.is_directory()) continue;
    const std::string path = entry.path().lexically_relative(prefix).string();
    INFO(path);
    if (path.rfind("include/", 0) == 0)
      headers.push_back(path);
    else
      CHECK((path.rfind(LIBRARY_FOLDER "/libsvnet.so", 0) == 0 || path.rfind(LIBRARY_FOLDER "/cmake/svnet/", 0) == 0));
    if (entry.path().extension() == ".cmake") {
      CHECK_THAT(file_contents(entry.path()), !Catch::Contains(BUILD_FOLDER));
      CHECK_THAT(file_contents(entry.path()), !Catch::Contains(first.string()));
    }
  }
  std::sort(headers.begin(), headers.end());
  CHECK(headers == std::vector<std::string>{"include/svnet/svnet.h", "include/svnet/svnet.hpp"});

  const std::string build = folder.path() / "build";
  output_of(folder, CMAKE " -S " CONSUMER_PROJECT " -B " + build + " -DCMAKE_PREFIX_PATH='" + prefix.string() +
                        "' -DCMAKE_C_COMPILER=" C_COMPILER " -DCMAKE_CXX_COMPILER=" CXX_COMPILER
                        " -DCMAKE_C_FLAGS='" SANITIZER_FLAG "' -DCMAKE_CXX_FLAGS='" SANITIZER_FLAG "'");
  output_of(folder, CMAKE " --build " + build);

  const std::string model = folder.path() / "model.safetensors", picture = folder.path() / "top.png";
  const Image image = small_picture();
  write_model(model, small_model());
  write_png(picture, image);
  const std::string raw = folder.write("top.ppm", ppm(image));
  const auto expected =
      nlohmann::json::parse(output_of(folder, SVNET_PREDICT " " + model + " --image " + picture + " --json"));
  std::map<std::pair<double, double>, double> score_of;
  for (const auto& view : expected.at("views"))
    score_of[{view.at("theta_deg").get<double>(), view.at("phi_deg").get<double>()}] = view.at("score").get<double>();

  const std::vector<Pose> poses = paper_grid();
  REQUIRE(score_of.size() == poses.size());
  std::string arguments = " " + model + " " + raw;
  for (const Pose& pose : poses) arguments += joined(" ", pose.theta_deg, " ", pose.phi_deg);
  for (const char* program : {"/score_c", "/score_cpp"}) {
    INFO(program);
    std::istringstream lines(output_of(folder, build + program + arguments));
    for (const Pose& pose : poses) {
      double score = -1;
      REQUIRE(lines >> score);
      CHECK(std::abs(score - score_of.at({pose.theta_deg, pose.phi_deg})) <= 1e-6);
    }
    std::size_t best = poses.size();
    REQUIRE(lines >> best);
    REQUIRE(best < poses.size());
    CHECK(poses[best].theta_deg == expected.at("best").at("theta_deg"));
    CHECK(poses[best].phi_deg == expected.at("best").at("phi_deg"));
  }

  // Linked from where it was moved to, and free of what belongs to training and to the commands.
  std::string libraries = output_of(folder, "ldd " + build + "/score_c");
  CHECK_THAT(libraries, Catch::Contains(prefix.string() + "/" LIBRARY_FOLDER "/libsvnet.so.0"));
  std::transform(libraries.begin(), libraries.end(), libraries.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* name : {"opencv", "hdf5", "yaml", "libpng", "jpeg", "webp", "spdlog", "not found"}) {
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
