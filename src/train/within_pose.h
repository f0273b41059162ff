#pragma once
#include <optional>
#include <span>
#include <vector>

#include "data/view_dataset.h"

namespace svnet::train {

/// How well predictions order the views of each pose: means over the poses of some categories.
struct WithinPose {
  Index poses = 0;              ///< with at least 3 scored views; all else is NaN if there are none
  double spearman = 0;          ///< rank correlation of predictions and scores (Spearman, mean ranks for ties)
  double regret = 0;            ///< score of the best view minus that of the chosen one
  double better_than_top = 0;   ///< share of poses whose chosen view scores higher than the top view
  double better_than_rand = 0;  ///< share of poses whose chosen view scores higher than the mean of the pose
};

/// `predicted` and `scores` have an element per view; views without a finite score do not count. The chosen view is the
/// first with the highest prediction.
WithinPose within_pose(const ViewDataset& dataset, std::span<const double> predicted, std::span<const double> scores,
                       const std::vector<bool>& categories);

/// The same of one pose, with the predictions and scores of its views. `top` is the top view among them, nullopt: it
/// has no score, and no view is better.
WithinPose within_one_pose(std::span<const double> predicted, std::span<const double> scores,
                           std::optional<std::size_t> top);

/// The means over all poses of several groups of poses.
WithinPose mean_of(std::span<const WithinPose> groups);

/// Spearman's rank correlation; 0 if one of the two is constant. Requires two values or more, as many in both.
double rank_correlation(std::span<const double> a, std::span<const double> b);

}  // namespace svnet::train
