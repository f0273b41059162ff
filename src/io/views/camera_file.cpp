#include "io/views/camera_file.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace svnet {
namespace {

using json = nlohmann::ordered_json;  // for reading too: a second kind of JSON takes seconds to compile

/// The numbers of an object with exactly these keys, and `optional` perhaps.
std::vector<double> numbers(const json& object, const std::string& where, const std::vector<std::string>& keys,
                            const std::string& optional = "") {
  check(object.is_object(), where, ": is no JSON object");
  for (const auto& [key, value] : object.items())
    check(key == optional || std::find(keys.begin(), keys.end(), key) != keys.end(), where, ": the key '",
          printable(key), "' is not known");
  std::vector<double> values;
  for (const std::string& key : keys) {
    check(object.contains(key), where, ": the key '", key, "' is missing");
    check(object.at(key).is_number(), where, ": ", key, " is not a number");
    values.push_back(object.at(key).get<double>());
  }
  return values;
}

}  // namespace

CameraFile read_camera(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::ifstream file(path, std::ios::binary);
  check(file && !std::filesystem::is_directory(path), name, ": cannot be read; expected a JSON file of a camera");
  json document;
  try {
    document = json::parse(file);
  } catch (const json::exception& error) {
    fail(name, ": is not JSON: ", printable(error.what()));
  }
  const auto n = numbers(document, name, {"width", "height", "fx", "fy", "cx", "cy"}, "pose");
  for (int i = 0; i < 2; ++i)
    check(n[i] == std::floor(n[i]) && std::abs(n[i]) < 1e6, name, ": ", i == 0 ? "width" : "height", " is ", n[i],
          ", expected a number of pixels");
  CameraFile camera{{static_cast<Index>(n[0]), static_cast<Index>(n[1]), n[2], n[3], n[4], n[5]}, {}};
  const std::string problem = intrinsics_problem(camera.intrinsics);
  check(problem.empty(), name, ": ", problem);
  if (!document.contains("pose")) return camera;
  const auto p = numbers(document.at("pose"), name + ": pose", {"x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"});
  const Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
  check(std::abs(rotation.norm() - 1) < 1e-3, name, ": pose: the quaternion has length ", rotation.norm(),
        ", expected 1");
  constexpr double kFarthest_m = 1e6;
  for (int i = 0; i < 3; ++i)
    check(std::abs(p[i]) < kFarthest_m, name, ": pose: ", "xyz"[i], "_m is ", p[i], ", expected metres in the world");
  camera.camera_to_world = Eigen::Translation3d(p[0], p[1], p[2]) * rotation.normalized();
  return camera;
}

std::string camera_json(const CameraFile& camera) {
  const Intrinsics& k = camera.intrinsics;
  json document{{"width", k.width}, {"height", k.height}, {"fx", k.fx},
                                  {"fy", k.fy},       {"cx", k.cx},         {"cy", k.cy}};
  if (camera.camera_to_world) {
    const Eigen::Vector3d t = camera.camera_to_world->translation();
    const Eigen::Quaterniond q = orientation(*camera.camera_to_world);
    document["pose"] = {{"x_m", t.x()}, {"y_m", t.y()}, {"z_m", t.z()}, {"qx", q.x()},
                        {"qy", q.y()},  {"qz", q.z()},  {"qw", q.w()}};
  }
  return document.dump(2) + "\n";
}

}  // namespace svnet
