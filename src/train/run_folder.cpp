#include "train/run_folder.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "base/error.h"
#include "io/files/make_folder.h"
#include "io/views/dataset_folder.h"
#include "train/config/config_file.h"

namespace svnet::train {
using io::FileLock;

namespace {

namespace fs = std::filesystem;

/// Whether somebody wrote the configuration by hand: runs write it without comments.
bool is_by_hand(const fs::path& config) {
  std::ifstream lines(config);
  for (std::string line; std::getline(lines, line);)
    if (line.find('#') != std::string::npos) return true;
  try {
    static_cast<void>(read_config(config));
    return false;
  } catch (const Error&) {
    return true;
  }
}

bool is_named_as_result(const fs::path& file) {
  const std::string name = file.filename().string(), extension = file.extension().string();
  return name == "model.safetensors" || name == "metrics.csv" || name == "scores.h5" || name == "evaluation.json" ||
         name == "crossval.json" || name == "predictions.json" || name == "report.html" || name == "views.png" ||
         ((name.starts_with("features-") || name.starts_with("scores-")) && extension == ".h5") ||
         (name.starts_with("checkpoint-") && extension == ".safetensors");
}

/// Whether a reader of the dataset would find the folder.
bool is_among_images(const fs::path& folder, const fs::path& root) {
  const fs::path relative = fs::weakly_canonical(folder).lexically_relative(fs::weakly_canonical(root));
  if (relative.empty() || *relative.begin() == "..") return false;
  return relative == "." || std::none_of(relative.begin(), relative.end(), io::is_ignored_name);
}

}  // namespace

void check_run_folder(const fs::path& folder, const fs::path& dataset_root) {
  check(!is_among_images(folder, dataset_root), folder.string(), ": lies in the data set ", dataset_root.string(),
        "; give another folder for the run");
  if (!fs::is_directory(folder)) return;
  const fs::path config = folder / "config.yaml";
  if (fs::exists(config)) {
    check(!is_by_hand(config), config.string(),
          ": was not written by a run, which would take its place; give another folder for the run");
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder))
    check(!is_named_as_result(entry.path()), entry.path().string(),
          ": a run would take its place, but no run was here, there is no config.yaml; give another folder");
}

std::unique_ptr<FileLock> lock_run_folder(const fs::path& folder) {
  io::make_folder(folder);
  auto lock = std::make_unique<FileLock>(folder / "log.txt");
  check(lock->held(), folder.string(),
        ": another svnet-train is at work in this run folder; wait until it ends, or give another folder by --output");
  return lock;
}

}  // namespace svnet::train
