#pragma once
#include <filesystem>
#include <string>

namespace svnet {

/// What the names of a file's or folder's temporaries begin with, which lie beside it; PID-N.tmp follows. The target's
/// name is cut so that they are not longer than file systems allow.
inline std::string temporary_prefix(const std::filesystem::path& target) {
  return ".svnet-" + target.filename().string().substr(0, 200) + "-";
}

}  // namespace svnet
