#pragma once
#include <filesystem>
#include <string>

namespace svnet::io {

/// The start of the names of the temporary files or folders of `target`; PID-N.tmp follows. At most 200 bytes of the
/// target's name are used, because file systems limit the length of names.
inline std::string temporary_prefix(const std::filesystem::path& target) {
  return ".svnet-" + target.filename().string().substr(0, 200) + "-";
}

}  // namespace svnet::io
