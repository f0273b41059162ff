#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "nn/runtime/inference_options.h"
#include "train/config/config.h"

namespace svnet::train {

/// What stages that run inside another one have taken of its time (stage_times.h).
struct StageClock {
  double inner_seconds = 0;
};

/// One run: a configuration, its dataset and its folder. Every stage (train/stages/) is a function of the run and of
/// what earlier stages returned:
///   features-<backbone>[-<layer>].h5 -> scores[-<backbone>][-round-<n>].h5 -> checkpoint-*.safetensors, metrics.csv,
///   model.safetensors -> evaluation.json, views.png
/// timings.csv says how long each of them took.
/// The processes of a communicator share the work. Each of them gets all results; the root process writes the files.
struct Run {
  Config config;
  ViewDataset dataset;
  std::filesystem::path folder;
  std::vector<bool> held_out;  ///< per category
  Messages messages;
  Communicator& communicator;
  InferenceOptions inference{};
  std::string dataset_fingerprint{};  ///< of the dataset's images
  std::shared_ptr<StageClock> clock = std::make_shared<StageClock>();

  std::uint64_t seed() const { return static_cast<std::uint64_t>(config.seed); }
  /// Per category: the opposite of held_out.
  std::vector<bool> training_categories() const;
  /// Whether problems can be drawn from the held-out categories: there are at least 2.
  bool has_held_out_problems() const;
  void say(const std::string& line) const;
};

/// Makes the run's folder if there is none, hashes the dataset's images, and checks the configuration before any work:
/// categories, backbones, layers, weights, pipelines, selectors, problems. Throws Error if something does not fit.
/// Returns the run.
Run make_run(Config config, ViewDataset dataset, std::filesystem::path folder, const Messages& messages,
             Communicator& communicator = SingleProcess::shared(), const InferenceOptions& inference = {});

/// `run` with another configuration of the same dataset and folder, checked as make_run checks it. Throws Error if it
/// names another dataset, reads its images otherwise or holds other categories out.
Run with_config(const Run& run, Config config);

/// Writes config.yaml, the resolved configuration, into the run folder.
void write_config(const Run& run);

}  // namespace svnet::train
