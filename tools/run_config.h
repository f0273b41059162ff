#pragma once
#include <filesystem>

#include "train/config/config.h"

namespace svnet::command {

/// The config.yaml of a run folder, below the folder itself and not a link to it: the paths in it are relative to that.
/// Throws Error if the folder is no run folder.
std::filesystem::path config_file_of(const std::filesystem::path& run_folder);

/// Throws Error, with what to do, unless the data of a run are where its configuration says.
void check_data_exist(const train::Config& config);

}  // namespace svnet::command
