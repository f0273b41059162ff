#include "io/views/camera_file.h"

#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <new>
#include <nlohmann/json.hpp>

#include <yaml-cpp/yaml.h>

#include "base/error.h"
#include "base/text.h"
#include "io/views/camera_layouts.h"

namespace svnet::io {
namespace {

using json = nlohmann::ordered_json;  // for reading too: a second kind of JSON takes seconds to compile

constexpr int kMostValues = 10'000, kDeepest = 64;

/// YAML as JSON: a scalar without quotes that is a number becomes one. Aliases are written out, and a few lines of
/// aliases of aliases may stand for any number of values, so Error, which begins with `name`, if there are not `left`.
/// A list may be an element of itself, so Error below kDeepest too.
json json_of(const YAML::Node& node, const std::string& name, int& left, int depth = 0) {
  check(depth < kDeepest, name, ": lists are nested too deeply, expected a camera");
  check(left-- > 0, name, ": holds more than ", kMostValues, " values, expected a camera");
  switch (node.Type()) {
    case YAML::NodeType::Scalar: {
      double number = 0;
      const std::string& text = node.Scalar();
      if (node.Tag() != "!" && parse_number(text, number)) return number;
      return text;
    }
    case YAML::NodeType::Sequence: {
      json list = json::array();
      for (const YAML::Node& item : node) list.push_back(json_of(item, name, left, depth + 1));
      return list;
    }
    case YAML::NodeType::Map: {
      json mapping = json::object();
      for (const auto& entry : node) mapping[entry.first.Scalar()] = json_of(entry.second, name, left, depth + 1);
      return mapping;
    }
    case YAML::NodeType::Null:
    case YAML::NodeType::Undefined:
      return nullptr;
  }
  return nullptr;
}

/// `text` as JSON if it begins like JSON, otherwise as YAML; rostopic and ros2 topic echo end a message with "---".
json document_in(const std::string& text, const std::string& name) {
  const auto first = text.find_first_not_of(" \t\r\n");
  check(first != std::string::npos, name, ": is empty, expected a camera");
  if (text[first] == '{' || text[first] == '[') {
    try {
      return json::parse(text);
    } catch (const json::exception& error) {
      fail(name, ": is not JSON: ", printable(error.what()));
    }
  }
  try {
    int left = kMostValues;
    return json_of(YAML::Load(text), name, left);
  } catch (const YAML::Exception& error) {
    fail(name, ":", error.mark.line + 1, ": is neither JSON nor YAML: ", printable(error.msg));
  }
}

Eigen::Isometry3d pose_of(const json& pose, const std::string& name) {
  const std::vector<std::string> keys{"x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"};
  check(pose.is_object(), name, ": is no mapping of keys to values");
  check_keys(pose, name, keys);
  std::vector<double> p;
  p.reserve(keys.size());
  for (const std::string& key : keys) p.push_back(number_at(pose, name, key));
  const Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
  check(std::abs(rotation.norm() - 1) < 1e-3, name, ": the quaternion has length ", rotation.norm(), ", expected 1");
  constexpr double kFarthest_m = 1e6;
  for (int i = 0; i < 3; ++i)
    check(std::abs(p[i]) < kFarthest_m, name, ": ", "xyz"[i], "_m is ", p[i], ", expected metres in the world");
  return Eigen::Translation3d(p[0], p[1], p[2]) * rotation.normalized();
}

}  // namespace

CameraFile read_camera(const std::filesystem::path& path) {
  const std::string name = path.string();
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOMEM) throw std::bad_alloc();
  check(file && !std::filesystem::is_directory(path), name,
        ": cannot be read; expected a JSON or YAML file of a camera");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const json document = document_in(text, name);
  CameraFile camera{intrinsics_of(document, name), {}};
  if (document.contains("pose")) camera.camera_to_world = pose_of(document.at("pose"), name + ": pose");
  return camera;
}

std::string camera_json(const CameraFile& camera) {
  const view::Intrinsics& k = camera.intrinsics;
  json document{{"width", k.width}, {"height", k.height}, {"fx", k.fx}, {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy}};
  if (camera.camera_to_world) {
    for (const auto& [key, number] : view::position_and_orientation(*camera.camera_to_world))
      document["pose"][key] = number;
  }
  return document.dump(2) + "\n";
}

}  // namespace svnet::io
