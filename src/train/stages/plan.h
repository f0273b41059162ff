#pragma once
#include <optional>
#include <string>
#include <vector>

#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// What svnet-train will do in a stage.
struct PlannedStage {
  std::string stage{};              ///< as in timings.csv: "features of mobilenet_v2"
  std::string work{};               ///< "4866 images"
  bool is_made = false;             ///< its file has the fingerprint that is wanted
  std::optional<double> seconds{};  ///< about how long it will take, if it can be told
};

/// The stages features, scores and model. Times are measured: a few images go through the backbone, and a few thousand
/// problems on random features are solved, which takes a second or two; a training step of a head is made on zeros.
/// Stages that are made are not measured.
std::vector<PlannedStage> planned_stages(const Run& run, FeaturesStage& features);

}  // namespace svnet::train
