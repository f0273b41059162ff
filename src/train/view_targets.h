#pragma once
#include <span>
#include <vector>

#include "data/scores.h"
#include "data/view_dataset.h"
#include "train/config/choices.h"

namespace svnet::train {

/// What SV-net learns of the views of a dataset, in its order.
struct ViewTargets {
  std::vector<double> values;   ///< in [0, 1] or near it; NaN: not learned
  std::vector<double> weights;  ///< in (0, 1]: how much is known of the value
};

/// The scores that SV-net learns, individual or global ones, of every view; NaN if a view has none.
template <class AllScores>
const std::vector<double>& target_scores(const AllScores& scores, Target target) {
  return target == Target::individual ? scores.individual : scores.global;
}

/// The targets of the views of `categories` that have a score, by `scale`:
///   scaled   the score, scaled to [0, 1] among the views of its pose; all weights are 1
///   centred  1/2 + the score minus the mean of its pose, weighted as score_weights says
/// Throws Error unless the rows of the scores are the dataset's views.
ViewTargets view_targets(const ViewDataset& dataset, const Scores& scores, const std::vector<bool>& categories,
                         Target target, TargetScale scale);

/// The variance of scores within their poses, with the degrees of freedom that the means leave; 0 if there are none.
/// Scores of a pose are neighbours.
double variance_within_poses(std::span<const double> scores, std::span<const std::int32_t> poses);

/// s² / (s² + e²), where e is the standard error of a score, the largest one if it is not known, and s the standard
/// deviation of scores within poses; 1 if s is 0. All spans have an element per score; scores of a pose are neighbours.
std::vector<double> score_weights(std::span<const double> scores, std::span<const double> standard_errors,
                                  std::span<const std::int32_t> poses);

}  // namespace svnet::train
