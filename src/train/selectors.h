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

/// Chooses one or more views of each pose. `view`: (poses, views), indices of views of the dataset, the most preferred
/// first. Empty: random views, drawn for each problem, no two of them the same unless the pose has fewer.
struct Selector {
  std::string name;
  std::vector<std::int32_t> view;
  Index views = 1;  ///< of each object
};

/// Semantic scores of every view; NaN for views of categories that take no part.
struct ViewScores {
  std::span<const double> individual, global;
};

/// Scores of every view for the next view, when `per_pose` views of each pose were taken: (poses, per_pose) indices.
using NextScores = std::function<std::vector<double>(std::span<const std::int32_t> taken, Index per_pose)>;

/// What selectors may base their choice on.
struct SelectorInputs {
  const ViewDataset& dataset;
  std::function<ViewScores()> scores;  ///< in problems of the table's own categories; computed on the first call
  std::span<const double> predicted;   ///< SV-net's score of every view
  const Scores& training_scores;       ///< of the training categories
  std::function<const std::vector<frame::TopFrame>&()> frames;  ///< of every pose; computed on the first call
  NextScores next{};                                            ///< empty: the model does not know
};

/// Which categories a table covers.
enum class Split { training, held_out };

/// One selector that a configuration can name.
struct SelectorKind {
  const char* name;
  const char* help;               ///< what it chooses, in a few words
  bool of_training, of_held_out;  ///< whether it is a default of the split's table
  Index fewest, most;             ///< views of an object that it can choose
  /// (poses, views), as in Selector.
  std::vector<std::int32_t> (*view)(const SelectorInputs& inputs, Index views);
};

/// All selectors. To add one, add an entry to the table in selectors.cpp.
std::span<const SelectorKind> selector_kinds();

/// The selectors with these names, in their order. Without names: the defaults of the split's table. Throws Error with
/// the nearest name if a name is unknown.
std::vector<const SelectorKind*> selectors_of_table(const std::vector<std::string>& names, Split split);

inline constexpr Index kMostViews = 8;
/// What these selectors choose of one view, then those that can of 2, …, `most_views` views: "svnet", "svnet_2".
std::vector<Selector> chosen_by(std::span<const SelectorKind* const> kinds, const SelectorInputs& inputs,
                                Index most_views);
std::string name_with_views(const std::string& selector, Index views);

/// The top view of each pose.
std::vector<std::int32_t> top_views(const ViewDataset& dataset);

/// The view of each pose that is nearest to φ 45° across the object's axis, whichever of the two sides; the lowest view
/// in azimuth order if no axis was found. `frames` are those of the poses.
std::vector<std::int32_t> broadside_views(const ViewDataset& dataset, std::span<const frame::TopFrame> frames);

/// The view of each pose whose elevation has the highest mean score; the first such view in the order of the views.
/// A view without a score does not count, and each score counts minus the mean of its pose.
std::vector<std::int32_t> phi_map_views(const ViewDataset& dataset, std::span<const double> scores);

/// The `count` views of each pose with the highest scores, best first; the first among equals. If fewer views of the
/// pose have a score they are repeated in turn; the top view if none has.
std::vector<std::int32_t> best_views(const ViewDataset& dataset, std::span<const double> scores, Index count = 1);

/// The best view of the `share` of poses in which its score is the most above that of the top view, and the top view of
/// the others.
std::vector<std::int32_t> moved_views(const ViewDataset& dataset, std::span<const double> scores, double share);

/// `first`, a view of each pose, and those to take after it, one after the other: each time the one with the highest
/// score given the views that were taken so far; `count` of each pose in all. Throws Error if `next` is empty.
std::vector<std::int32_t> views_after(const ViewDataset& dataset, const std::vector<std::int32_t>& first,
                                      const NextScores& next, Index count);

/// `first`, a view of each pose, and then count - 1 other ones as view_sets chooses them.
std::vector<std::int32_t> views_beside(const ViewDataset& dataset, const std::vector<std::int32_t>& first,
                                       std::span<const double> scores, Index count);

/// `count` views of each pose to take together, each judged beside those already chosen (view/view_set.h), otherwise as
/// best_views. For one view they are the same.
std::vector<std::int32_t> view_sets(const ViewDataset& dataset, std::span<const double> scores, Index count);

}  // namespace svnet::train
