#include "io/views/camera_layouts.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace svnet::io {
using view::Intrinsics;

namespace {

using json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

constexpr const char* kRectify =
    "; images must be rectified first (ROS: image_proc), and the camera of the rectified images given: no "
    "distortion";

Index pixels_at(const json& object, const std::string& name, const std::string& key) {
  const double n = number_at(object, name, key);
  check(n == std::floor(n) && std::abs(n) < 1e6, name, ": ", key, " is ", n, ", expected a number of pixels");
  return static_cast<Index>(n);
}

/// The numbers of a list, or of the "data" of a matrix {rows, cols, data}.
std::vector<double> numbers_at(const json& object, const std::string& name, const std::string& key) {
  const json* list = &object.at(key);
  if (list->is_object()) {
    check_keys(*list, name + ": " + key, {"rows", "cols", "data", "dt"});
    check(list->contains("data"), name, ": ", key, ": the key 'data' is missing");
    list = &list->at("data");
  }
  check(list->is_array(), name, ": ", key, " is not a list of numbers");
  std::vector<double> numbers;
  for (const json& item : *list) {
    check(item.is_number(), name, ": ", key, " is not a list of numbers");
    numbers.push_back(item.get<double>());
  }
  return numbers;
}

void check_undistorted(const json& object, const std::string& name, const std::string& key) {
  if (!object.contains(key) || object.at(key).is_null()) return;
  for (const double coefficient : numbers_at(object, name, key))
    check(coefficient == 0, name, ": ", key, ": the lens has distortion (", coefficient, ")", kRectify);
}

/// A fisheye lens without coefficients is no pinhole camera either: its radius is the angle times fx.
void check_model(const json& object, const std::string& name, const std::string& key) {
  if (!object.contains(key) || !object.at(key).is_string()) return;
  const std::string model = object.at(key).get<std::string>(), lower = lower_case(model);
  for (const char* fisheye : {"equidistant", "fisheye", "kannala", "ftheta", "f-theta"})
    check(lower.find(fisheye) == std::string::npos, name, ": ", key, ": '", printable(model), "' is a fisheye lens",
          kRectify);
}

/// The first of the keys that the object has; "" if it has none.
std::string present(const json& object, const Names& keys) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return object.contains(key); });
  return found == keys.end() ? "" : *found;
}

/// fx, fy, cx, cy of a matrix with rows of `columns` numbers.
Intrinsics with_matrix(Intrinsics camera, const std::vector<double>& matrix, std::size_t columns,
                       const std::string& where) {
  check(matrix.size() == 3 * columns, where, " has ", matrix.size(), " numbers, expected ", 3 * columns);
  camera.fx = matrix[0], camera.cx = matrix[2], camera.fy = matrix[columns + 1], camera.cy = matrix[columns + 2];
  check(matrix[1] == 0 && matrix[columns] == 0 && matrix[2 * columns] == 0 && matrix[2 * columns + 1] == 0 &&
            matrix[2 * columns + 2] == 1,
        where, " is not a pinhole camera's: expected fx 0 cx, 0 fy cy, 0 0 1");
  return camera;
}

bool same_pinhole(const Intrinsics& a, const Intrinsics& b) {
  constexpr double kSame_px = 0.5;
  return std::abs(a.fx - b.fx) < kSame_px && std::abs(a.fy - b.fy) < kSame_px && std::abs(a.cx - b.cx) < kSame_px &&
         std::abs(a.cy - b.cy) < kSame_px;
}

/// Images with fewer pixels than the sensor: their pixels are not those of K.
void check_whole(const json& object, const std::string& name) {
  for (const char* key : {"binning_x", "binning_y"})
    if (object.contains(key))
      check(number_at(object, name, key) <= 1, name, ": ", key, " is ", object.at(key).get<double>(),
            "; give the camera of the images as they are");
  if (!object.contains("roi")) return;
  const json& roi = object.at("roi");
  check(roi.is_object(), name, ": roi is not a mapping");
  for (const char* key : {"x_offset", "y_offset"})
    if (roi.contains(key))
      check(number_at(roi, name + ": roi", key) == 0, name, ": roi: ", key, " is not 0; give the camera of the ",
            "images as they are");
}

const Names kRosKeys{"K",
                     "k",
                     "P",
                     "p",
                     "D",
                     "d",
                     "R",
                     "r",
                     "camera_matrix",
                     "projection_matrix",
                     "distortion_coefficients",
                     "rectification_matrix",
                     "distortion_model"};

Intrinsics ros_camera(const json& document, const std::string& name) {
  Names known{"width",     "height", "image_width", "image_height", "camera_name", "binning_x",
              "binning_y", "header", "frame_id",    "roi",          "pose"};
  known.insert(known.end(), kRosKeys.begin(), kRosKeys.end());
  check_keys(document, name, known);
  const bool is_file = document.contains("image_width") || document.contains("image_height");
  Intrinsics camera{.width = pixels_at(document, name, is_file ? "image_width" : "width"),
                    .height = pixels_at(document, name, is_file ? "image_height" : "height")};
  for (const char* key : {"D", "d", "distortion_coefficients"}) check_undistorted(document, name, key);
  check_model(document, name, "distortion_model");
  check_whole(document, name);
  const std::string matrix = present(document, {"K", "k", "camera_matrix"}),
                    projection = present(document, {"P", "p", "projection_matrix"});
  check(!matrix.empty() || !projection.empty(), name, ": the key '", is_file ? "camera_matrix" : "K", "' is missing");
  const std::vector<double> p = projection.empty() ? std::vector<double>() : numbers_at(document, name, projection);
  if (matrix.empty()) return with_matrix(camera, p, 4, name + ": " + projection);
  const std::vector<double> k = numbers_at(document, name, matrix);
  check(k.empty() || k[0] != 0, name, ": ", matrix, " is 0: the camera is not calibrated");
  camera = with_matrix(camera, k, 3, name + ": " + matrix);
  if (p.empty() || p[0] == 0) return camera;  // ROS: not calibrated
  const Intrinsics rectified = with_matrix(camera, p, 4, name + ": " + projection);
  check(same_pinhole(camera, rectified), name, ": ", matrix, " and ", projection, " are different cameras; leave out ",
        projection, " if the images are as taken, or give its numbers as ", matrix, " if they are rectified");
  return camera;
}

/// The pinhole camera whose principal point is under these keys.
Intrinsics pinhole_at(const json& document, const std::string& name, const char* cx, const char* cy) {
  return {.width = pixels_at(document, name, "width"),
          .height = pixels_at(document, name, "height"),
          .fx = number_at(document, name, "fx"),
          .fy = number_at(document, name, "fy"),
          .cx = number_at(document, name, cx),
          .cy = number_at(document, name, cy)};
}

Intrinsics realsense_camera(const json& document, const std::string& name) {
  check_keys(document, name,
             {"width", "height", "fx", "fy", "ppx", "ppy", "model", "coeffs", "fov", "stream", "format", "pose"});
  check_undistorted(document, name, "coeffs");
  check_model(document, name, "model");
  return pinhole_at(document, name, "ppx", "ppy");
}

Intrinsics plain_camera(const json& document, const std::string& name) {
  check_keys(document, name, {"width", "height", "fx", "fy", "cx", "cy", "pose"});
  return pinhole_at(document, name, "cx", "cy");
}

}  // namespace

void check_keys(const json& object, const std::string& name, const Names& known) {
  for (const auto& [key, unused] : object.items())
    check(std::find(known.begin(), known.end(), key) != known.end(), name, ": the key '", printable(key),
          "' is not known; known: ", joined_with(", ", known));
}

double number_at(const json& object, const std::string& name, const std::string& key) {
  check(object.contains(key), name, ": the key '", key, "' is missing");
  check(object.at(key).is_number(), name, ": ", key, " is not a number");
  return object.at(key).get<double>();
}

Intrinsics intrinsics_of(const json& document, const std::string& name) {
  check(document.is_object(), name, ": is no mapping of keys to values, expected a camera");
  Intrinsics camera;
  if (!present(document, kRosKeys).empty() || document.contains("image_width"))
    camera = ros_camera(document, name);
  else if (!present(document, {"ppx", "ppy", "coeffs"}).empty())
    camera = realsense_camera(document, name);
  else
    camera = plain_camera(document, name);
  const std::string problem = intrinsics_problem(camera);
  check(problem.empty(), name, ": ", problem);
  return camera;
}

}  // namespace svnet::io
