#pragma once
#include <filesystem>

namespace svnet::io {

/// Where the work that a file needs is kept while it is made: FILE.snapshot.
inline std::filesystem::path snapshot_path(std::filesystem::path file) {
  file += ".snapshot";
  return file;
}

}  // namespace svnet::io
