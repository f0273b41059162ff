#pragma once
#include <filesystem>
#include <string>

namespace svnet::io {

/// All bytes of a regular file. Throws Error that names it if it cannot be read.
std::string whole_file(const std::filesystem::path& path);

}  // namespace svnet::io
