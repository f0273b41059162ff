#pragma once
#include <filesystem>
#include <vector>

#include "view/pose.h"

namespace svnet {

/// Camera poses from a CSV file: the header `theta,phi`, then one pose per line, in degrees. Spaces around values,
/// empty lines and a carriage return at a line's end do not matter. Throws Error that names file and line where a line
/// is not two numbers in range (view/pose.h), or the file where it cannot be read or has no pose.
std::vector<Pose> read_pose_list(const std::filesystem::path& path);

}  // namespace svnet
