#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

#include "view/camera.h"

namespace svnet::io {

/// A camera and, if known, the pose of its optical frame in the world.
struct CameraFile {
  view::Intrinsics intrinsics;
  std::optional<Eigen::Isometry3d> camera_to_world;
};

/// A JSON file: {"width": 640, "height": 480, "fx": 600, "fy": 600, "cx": 319.5, "cy": 239.5, "pose": {"x_m": 0, "y_m":
/// 0, "z_m": 1, "qx": 0, "qy": 1, "qz": 0, "qw": 0}}, or the same as YAML. The key "pose" is optional. Intrinsics may
/// also have the layout of ROS or RealSense (camera_layouts.h). Throws Error that names the file and the key for
/// anything else.
CameraFile read_camera(const std::filesystem::path& path);

/// The text of such a file.
std::string camera_json(const CameraFile&);

}  // namespace svnet::io
