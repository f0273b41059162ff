#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "semantics/clustering_problems.h"

namespace svnet::semantics {

/// How strongly on-policy draws prefer the views with high predictions.
struct OnPolicyOptions {
  /// The effective number of views of the softmax, as a share of the views of the pose. Of 21 views a fifth is 4, which
  /// is what a temperature of 0.35 standard deviations of the predictions gives if they are normally distributed. With
  /// fewer, scores would depend on the few views that one model happens to like; with many more, they are uniform ones.
  double effective_share = 0.2;
  /// The share of the draws that is uniform. Every view keeps a score: it is drawn at least a quarter as often as
  /// uniformly, so its standard error is at most twice as large.
  double uniform_share = 0.25;
};

/// Weights that draw the view of a pose roughly as a selector that follows the predictions would: within each pose
///   (1 - uniform_share) softmax(prediction / temperature) + uniform_share / views.
/// The temperature of a pose is such that exp(entropy of the softmax) is effective_share times the number of its views,
/// found by bisection; so neither shift nor scale of the predictions matters. If more views than that share the highest
/// prediction, the softmax is uniform among them. Equal predictions: uniform. A view whose prediction is not finite has
/// its uniform share only. The weights of a pose add up to 1.
///
/// prediction, pose_of_view: (views). Throws Error if the lengths differ, a pose is negative or a share is out of (0,
/// 1].
ViewWeights on_policy_weights(std::span<const double> prediction, std::span<const std::int32_t> pose_of_view,
                              const OnPolicyOptions& options = {});

}  // namespace svnet::semantics
