#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "frame/object_axis.h"
#include "report/box_plot.h"
#include "report/estimate.h"
#include "report/scatter.h"
#include "train/metrics.h"
#include "train/stage_times.h"
#include "train/within_pose.h"

// All that the page of a run shows, as plain values. collect.h makes it of a run folder, write_report.h shows it.
namespace svnet::report {

/// A setting, or another fact about a run, in words.
struct Setting {
  std::string name, value;
};

/// A table of the evaluation.
struct Table {
  bool held_out = false;
  std::vector<std::string> pipelines, selectors;
  std::vector<std::vector<train::PerMetric<Estimate>>> cells;  ///< [pipeline][selector]
  double largest_standard_error = 0;                           ///< of a mean over problems
  /// SV-net minus another selector: a row per pipeline, and one of their mean if there are several.
  struct Lead {
    std::string over;
    std::vector<train::PerMetric<Estimate>> rows;
  };
  std::vector<Lead> leads;
  std::uint64_t problems = 0;
};

struct Picture {
  std::string jpeg;
  Index width = 0, height = 0;
};

/// A view of a held-out pose.
struct ShownView {
  int theta_deg = 0, phi_deg = 0;
  double predicted = 0, score = 0;  ///< by SV-net, and in problems; NaN: not known
  double standard_error = 0;        ///< of the score
};

/// A held-out pose.
struct ShownPose {
  std::string category, object, pose;
  std::vector<ShownView> views;
  std::size_t top = 0, chosen = 0;
  std::optional<std::size_t> best{}, worst{};  ///< by score, if one is known
  double mean_score = 0;                       ///< of a random view
  /// Images of the top view, the chosen and the best one.
  std::optional<std::array<Picture, 3>> pictures{};
  /// Measured on the top view, if the pose is shown as a figure.
  std::optional<frame::ObjectAxis> axis{};
};

/// Values of each epoch; NaN: none.
struct TrainingCurves {
  std::vector<double> loss, validation_loss, validation_spearman, validation_regret;
};

/// Scores of the views of a category.
struct CategoryScores {
  bool held_out = false;
  BoxRow row;
};

/// Features of two sets of views in their first two principal components.
struct FeatureMap {
  std::string backbone;
  Index dimension = 0;
  std::vector<std::string> categories;
  std::vector<ScatterPoint> top, chosen;
  double top_silhouette = 0, chosen_silhouette = 0;  ///< mean silhouette in all dimensions
};

struct FoldFigures {
  std::vector<std::string> held_out;
  train::WithinPose within_pose;
};

struct RunReport {
  std::string name;  ///< of the run folder
  bool cross_validation = false;
  bool closed_form = false;                   ///< whether the head is fitted without epochs, from no random start
  std::vector<std::string> random_backbones;  ///< those without trained weights
  std::vector<Setting> settings;
  Index training_categories = 0, held_out_categories = 0;
  std::string target;         ///< "individual" or "global"
  std::vector<Table> tables;  ///< held-out categories first
  std::vector<FoldFigures> folds;
  std::vector<ShownPose> poses;  ///< of held-out categories, in the dataset's order
  std::optional<TrainingCurves> curves;
  std::vector<CategoryScores> scores;
  std::optional<FeatureMap> map;
  std::vector<train::StageTime> times;
};

}  // namespace svnet::report
