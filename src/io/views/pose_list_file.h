#pragma once
#include <filesystem>
#include <vector>

#include "view/camera_pose.h"

namespace svnet {

/// Camera poses from a CSV file: a header that begins with `theta,phi`, then one pose per line, in degrees. Further
/// columns, spaces around values, empty lines and a carriage return at a line's end do not matter. Throws Error that
/// names file and line where a line does not begin with two numbers in range (view/camera_pose.h) or has other columns
/// than the header, or the file where it cannot be read or has no pose.
std::vector<CameraPose> read_pose_list(const std::filesystem::path& path);

}  // namespace svnet
