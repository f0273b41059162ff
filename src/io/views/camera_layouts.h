#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "view/camera.h"

// The layouts of camera intrinsics that are read. Each function throws Error that begins with `name` and names the key.
namespace svnet::io {

/// The keys of a camera of any layout, "pose" among them, are those of one of:
///   svnet              width, height, fx, fy, cx, cy
///   RealSense          width, height, fx, fy, ppx, ppy, model, coeffs: rs2_intrinsics
///   ROS, message       width, height, distortion_model, D, K, R, P and the rest of sensor_msgs/CameraInfo; ROS 2
///   writes
///                      d, k, r, p
///   ROS, file          image_width, image_height, camera_matrix, distortion_coefficients and so on, as
///                      camera_calibration_parsers writes them
/// Lenses must have no distortion: all coefficients are 0.
view::Intrinsics intrinsics_of(const nlohmann::ordered_json& document, const std::string& name);

/// Throws Error unless `object` is a mapping with these keys only.
void check_keys(const nlohmann::ordered_json& object, const std::string& name, const std::vector<std::string>& known);

/// The number at `key`.
double number_at(const nlohmann::ordered_json& object, const std::string& name, const std::string& key);

}  // namespace svnet::io
