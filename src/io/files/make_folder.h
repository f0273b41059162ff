#pragma once
#include <filesystem>

namespace svnet::io {

/// Makes a folder, with those above it, if there is none. Throws Error that names it if that fails, or if something
/// else has its name.
void make_folder(const std::filesystem::path& folder);

}  // namespace svnet::io
