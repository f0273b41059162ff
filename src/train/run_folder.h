#pragma once
#include <filesystem>

namespace svnet {

/// Throws Error if a run in `folder` would overwrite files that no run wrote (a config.yaml written by hand, or results
/// without a config.yaml), or if the folder lies inside the dataset. The folder need not exist.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& dataset_root);

}  // namespace svnet
