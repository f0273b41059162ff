#pragma once
#include <filesystem>
#include <memory>

#include "io/files/file_lock.h"

namespace svnet::train {

/// Throws Error if a run in `folder` would overwrite files that no run wrote (a config.yaml written by hand, or results
/// without a config.yaml), or if the folder lies inside the dataset. The folder need not exist.
void check_run_folder(const std::filesystem::path& folder, const std::filesystem::path& dataset_root);

/// Makes the folder if there is none, and keeps other processes from training in it while the result exists. Throws
/// Error if one does so already. The lock is on log.txt, which is never replaced.
std::unique_ptr<io::FileLock> lock_run_folder(const std::filesystem::path& folder);

}  // namespace svnet::train
