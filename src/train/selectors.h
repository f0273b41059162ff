#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "data/scores.h"
#include "data/view_dataset.h"
#include "frame/top_frame.h"

namespace svnet::train {

/// Chooses a view of each pose. `view`: per pose of the dataset, the index of the chosen view. Empty: a random view,
/// drawn for each problem.
struct Selector {
  std::string name;
  std::vector<std::int32_t> view;
};

/// Semantic scores of every view; NaN for views of categories that take no part.
struct ViewScores {
  std::span<const double> individual, global;
};

/// What selectors may base their choice on.
struct SelectorInputs {
  const ViewDataset& dataset;
  std::function<ViewScores()> scores;  ///< in problems of the table's own categories; computed on the first call
  std::span<const double> predicted;   ///< SV-net's score of every view
  const Scores& training_scores;       ///< of the training categories
  std::function<const std::vector<frame::TopFrame>&()> frames;  ///< of every pose; computed on the first call
};

/// Which categories a table covers.
enum class Split { training, held_out };

/// One selector that a configuration can name.
struct SelectorKind {
  const char* name;
  const char* help;               ///< what it chooses, in a few words
  bool of_training, of_held_out;  ///< whether it is a default of the split's table
  std::vector<std::int32_t> (*view)(const SelectorInputs& inputs);
};

/// All selectors. To add one, add an entry to the table in selectors.cpp.
std::span<const SelectorKind> selector_kinds();

/// The selectors with these names, in their order. Without names: the defaults of the split's table. Throws Error with
/// the nearest name if a name is unknown.
std::vector<const SelectorKind*> selectors_of_table(const std::vector<std::string>& names, Split split);

/// The top view of each pose.
std::vector<std::int32_t> top_views(const ViewDataset& dataset);

/// The view of each pose that is nearest to φ 45° across the object's axis, whichever of the two sides; the lowest view
/// in azimuth order if no axis was found. `frames` are those of the poses.
std::vector<std::int32_t> broadside_views(const ViewDataset& dataset, std::span<const frame::TopFrame> frames);

/// The view of each pose whose elevation has the highest mean score; the first such view in the order of the views.
/// A view without a score does not count, and each score counts minus the mean of its pose.
std::vector<std::int32_t> phi_map_views(const ViewDataset& dataset, std::span<const double> scores);

/// The view of each pose with the highest score; the first among equals. The top view if no view of the pose has a
/// score.
std::vector<std::int32_t> best_views(const ViewDataset& dataset, std::span<const double> scores);

}  // namespace svnet::train
