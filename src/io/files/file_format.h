#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace svnet::io {

/// What a file seems to be that was expected to be something else, from its first bytes (up to 512 are looked at), with
/// what to do: ", but a Git LFS pointer; get the file itself by 'git lfs pull'". Empty if nothing is recognised.
std::string recognised_instead(std::string_view first_bytes);

/// The same for a file; empty too if it cannot be read.
std::string recognised_instead(const std::filesystem::path& file);

}  // namespace svnet::io
