#pragma once
#include <filesystem>

#include "base/environment.h"

/// The path of `relative` in the folder of data that is too large for the repository (SVNET_SHARED, default: ../shared
/// next to it). It may not exist: then the test skips with a message.
inline std::filesystem::path shared_folder(const std::filesystem::path& relative) {
  const std::string given = svnet::environment_variable("SVNET_SHARED");
  return std::filesystem::path(!given.empty() ? given : SVNET_SOURCE_DIR "/../shared") / relative;
}
