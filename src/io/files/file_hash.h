#pragma once
#include <filesystem>
#include <string>

namespace svnet::io {

/// The SHA-256 of a file's contents as 64 lower-case hexadecimal digits. Throws Error that names the file if it cannot
/// be read.
std::string file_sha256(const std::filesystem::path& path);

}  // namespace svnet::io
