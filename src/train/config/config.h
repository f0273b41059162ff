#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/exif_orientation.h"
#include "base/index.h"
#include "frame/frame_choice.h"
#include "models/sv_net.h"
#include "nn/optim/optimizer.h"
#include "nn/optim/schedule.h"
#include "semantics/cluster_metrics.h"
#include "semantics/clusterer.h"
#include "train/config/choices.h"

namespace svnet::train {

/// The values of the keys of a configuration file, with their defaults. config_table.cpp says what each key means and
/// accepts; configs/paper.yaml shows all of them. A backbone is a name of models/registry.h.
struct Config {
  struct Dataset {
    std::filesystem::path root;
    std::vector<std::string> held_out;
    ExifOrientation exif_orientation = ExifOrientation::ignore;
  };
  struct Weights {
    std::filesystem::path folder;  ///< empty: built-in weights, or random ones
  };
  struct Scores {
    std::string backbone = "xception";
    std::string layer;                   ///< of `backbone` alone
    std::vector<std::string> backbones;  ///< empty: `backbone`; see scored_backbones
    semantics::Clustering clustering = semantics::Clustering::ward;
    Index min_samples = 0;  ///< at least one of the three stop rules must be above 0
    Index problems = 0;
    double target_error = 0;
    Index min_categories = 3, max_categories = 0;
    Index min_objects = 1, max_objects = 0;
    semantics::Singletons singletons = semantics::Singletons::zero;
    Index rounds = 0;
  };
  struct SvNet {
    frame::FrameChoice frame = frame::FrameChoice::camera;
    frame::DepthChoice depth = frame::DepthChoice::none;
    HeadChoice head = HeadChoice::ridge;
    NextViewChoice next_view = NextViewChoice::none;
    std::string backbone = "vgg19";
    std::string layer;
    Index width = 4096;
    double dropout = 0.75;
    models::AngleEncoding angles = models::AngleEncoding::radians;
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
    TargetScale target = TargetScale::scaled;
    Index validation_categories = 0;
    Index patience = 0;
    FineTune fine_tune = FineTune::none;
    TopViewAugmentation augmentation = TopViewAugmentation::none;
  };
  struct Evaluation {
    Index problems = 10000;
    std::vector<std::string> pipelines;  ///< as pipeline_name.h reads them; parse_config fills an empty list
    std::vector<std::string> selectors;  ///< names of train/selectors.h; empty: the default ones of each table
    Index views = 1;                     ///< the most views of each object that are compared
    ViewsTogether fusion = ViewsTogether::mean;
    semantics::NmiAverage nmi = semantics::NmiAverage::arithmetic;
  };

  Preset preset = Preset::paper;
  Index seed = 0;
  Dataset dataset;
  Weights weights;
  Scores scores;
  SvNet sv_net;
  Training training;
  Evaluation evaluation;
};

/// The backbones whose features are clustered, each for scores of its own. Scores are the mean over them.
inline std::vector<std::string> scored_backbones(const Config::Scores& scores) {
  return scores.backbones.empty() ? std::vector{scores.backbone} : scores.backbones;
}

/// The layer of a backbone whose output is clustered; "": the pooled output.
inline std::string scored_layer(const Config::Scores& scores, const std::string& backbone) {
  return backbone == scores.backbone ? scores.layer : std::string();
}

}  // namespace svnet::train
