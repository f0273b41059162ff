#pragma once
#include <filesystem>
#include <string>

namespace svnet {

/// SHA-256 of the contents of a file, 64 lower-case hexadecimal digits. Throws Error that names the file.
std::string file_sha256(const std::filesystem::path& path);

}  // namespace svnet
