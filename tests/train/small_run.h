#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"
#include "train/config/config.h"

namespace svnet {

/// A run on the small dataset that takes a second.
inline train::Config small_config(const std::filesystem::path& data) {
  train::Config config;
  config.seed = 3;
  config.dataset.root = data;
  config.dataset.held_out = {"ring"};
  config.scores.backbone = config.sv_net.backbone = "tiny_xception";
  config.scores.problems = 300;
  config.scores.min_categories = 2;
  config.sv_net.width = 16;
  config.sv_net.dropout = 0.5;
  config.training.epochs = 4;
  config.training.batch_size = 5;
  config.evaluation.problems = 40;
  config.evaluation.pipelines = {"tiny_xception_ward", "tiny_xception_kmeans"};
  return config;
}

/// Keeps the lines of a run.
struct Log {
  std::vector<std::string> lines;
  Messages messages{.line = [this](std::string_view line) { lines.emplace_back(line); }, .progress = {}};
  bool has(const std::string& part) const {
    for (const auto& line : lines)
      if (line.find(part) != std::string::npos) return true;
    return false;
  }
};

}  // namespace svnet
