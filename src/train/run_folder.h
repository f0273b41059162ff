#pragma once
#include <filesystem>

namespace svnet {

/// Throws Error where a run in `folder` would take the place of files that no run has written, or lie among the
/// pictures of its data set: a config.yaml by hand, results without one. A folder that does not exist will do.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& dataset_root);

}  // namespace svnet
