#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/index.h"
#include "models/sv_net.h"
#include "nn/optim/optimizer.h"
#include "nn/optim/schedule.h"
#include "semantics/cluster_metrics.h"
#include "semantics/clusterer.h"
#include "train/config/choices.h"

namespace svnet {

/// What svnet-train and svnet-eval are told: the keys of a configuration file, with their defaults. Their meanings and
/// ranges stand in one table in config_table.cpp; configs/paper.yaml shows them all. Backbones are names of the
/// registry.
struct Config {
  struct Dataset {
    std::filesystem::path root;
    std::vector<std::string> held_out;
  };
  struct Weights {
    std::filesystem::path folder;  ///< empty: built-in weights, or random ones
  };
  struct Scores {
    std::string backbone = "xception";
    std::string layer;
    Clustering clustering = Clustering::ward;
    Index min_samples = 0;  ///< of the three stop rules at least one is above 0
    Index problems = 0;
    double target_error = 0;
    Index min_categories = 3, max_categories = 0;
    Index min_objects = 1, max_objects = 0;
    Singletons singletons = Singletons::zero;
  };
  struct SvNet {
    std::string backbone = "vgg19";
    std::string layer;
    Index width = 4096;
    double dropout = 0.75;
    AngleEncoding angles = AngleEncoding::radians;
    Target target = Target::individual;
    Orientations orientations = Orientations::as_taken;
  };
  struct Training {
    Index epochs = 10;
    Index batch_size = 32;
    double learning_rate = 1e-3;
    OptimizerKind optimizer = OptimizerKind::adam;
    double momentum = 0.9;
    Schedule::Kind schedule = Schedule::Kind::constant;
    Index step_epochs = 5;
    double step_factor = 0.1;
    Index validation_categories = 0;
    FineTune fine_tune = FineTune::none;
    TopViewAugmentation augmentation = TopViewAugmentation::none;
  };
  struct Evaluation {
    Index problems = 10000;
    std::vector<std::string> pipelines;  ///< empty only before parse_config has read the rest
    std::vector<std::string> selectors;  ///< names of train/selectors.h; empty: the default ones of each table
    NmiAverage nmi = NmiAverage::arithmetic;
  };

  Index seed = 0;
  Dataset dataset;
  Weights weights;
  Scores scores;
  SvNet sv_net;
  Training training;
  Evaluation evaluation;
};

/// One of evaluation.pipelines: "mobilenet_v2_ward" is features of mobilenet_v2 clustered by ward.
struct PipelineName {
  std::string backbone;
  Clustering clustering;
};
/// Throws Error, beginning with `where`, unless `name` is BACKBONE_CLUSTERING.
PipelineName parse_pipeline(const std::string& name, const std::string& where);

/// Reads a configuration. `source` is what errors call the text; relative paths in it are taken from `folder`, those in
/// `overrides` ("key=value", applied in order) from the working directory. Throws Error with file, line and key.
Config parse_config(const std::string& text, const std::string& source, const std::filesystem::path& folder,
                    std::span<const std::string> overrides = {});

/// Reads the file: the only function here that touches the disk.
Config read_config(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Every key with its value: parse_config reads back an equal configuration.
std::string to_yaml(const Config& config);

/// The same, each key below a comment with its meaning and what it accepts; paths are written relative to `folder`.
std::string documented_yaml(const Config& config, const std::filesystem::path& folder);

/// One key of the configuration, as help shows it.
struct ConfigKey {
  std::string name;           ///< "scores.min_samples"
  std::string help;           ///< its meaning
  std::string accepts;        ///< "a whole number >= 0"
  std::string default_value;  ///< as YAML
};
std::vector<ConfigKey> config_keys();

}  // namespace svnet
