#pragma once
#include <filesystem>
#include <vector>

#include "view/camera_pose.h"

namespace svnet::io {

/// Reads camera poses from a CSV file (RFC 4180: csv_reader.h): a header that begins with `theta,phi`, then one pose
/// per record, in degrees. Ignored are further columns, spaces around values and empty lines.
///
/// Throws Error that names the file and the line unless each record begins with two numbers in range up to rounding
/// (view/camera_pose.h) and has as many columns as the header. Throws Error that names the file if it cannot be read or
/// has no pose.
std::vector<view::CameraPose> read_pose_list(const std::filesystem::path& path);

}  // namespace svnet::io
