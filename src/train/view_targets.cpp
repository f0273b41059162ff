#include "train/view_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "semantics/score_sums.h"
#include "train/dataset_rows.h"
#include "train/pose_examples.h"

namespace svnet::train {
namespace {

/// Of the views that `targets` has weights and values for, in the dataset's order.
void centre(const ViewDataset& dataset, const Scores& scores, ViewTargets& targets) {
  std::vector<double> values, errors;
  std::vector<std::int32_t> poses;
  for (std::size_t v = 0; v < dataset.views.size(); ++v) {
    if (!std::isfinite(targets.values[v])) continue;
    values.push_back(targets.values[v]);
    errors.push_back(scores.standard_error[v]);
    poses.push_back(static_cast<std::int32_t>(dataset.views[v].pose));
  }
  const std::vector<double> weights = score_weights(values, errors, poses);
  for (std::size_t v = 0, at = 0; v < dataset.views.size(); ++v)
    if (std::isfinite(targets.values[v])) targets.weights[v] = weights[at++];
  for (const auto& pose : dataset.poses) {
    double sum = 0, count = 0;
    const auto each = [&](const auto& use) {
      for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v)
        if (double& value = targets.values[static_cast<std::size_t>(v)]; std::isfinite(value)) use(value);
    };
    each([&](double value) {
      sum += value;
      ++count;
    });
    each([&](double& value) { value += 0.5 - sum / count; });
  }
}

}  // namespace

double variance_within_poses(std::span<const double> scores, std::span<const std::int32_t> poses) {
  double squares = 0, freedom = 0;
  for (const auto& [begin, end] : pose_ranges(poses)) {
    double sum = 0, sum_of_squares = 0;
    for (std::size_t i = begin; i < end; ++i) {
      sum += scores[i];
      sum_of_squares += scores[i] * scores[i];
    }
    const auto count = static_cast<double>(end - begin);
    squares += sum_of_squares - sum * sum / count;
    freedom += count - 1;
  }
  return freedom > 0 ? squares / freedom : 0;
}

std::vector<double> score_weights(std::span<const double> scores, std::span<const double> standard_errors,
                                  std::span<const std::int32_t> poses) {
  double largest = 0;
  for (const double error : standard_errors)
    if (std::isfinite(error)) largest = std::max(largest, error);
  const double variance = variance_within_poses(scores, poses);
  std::vector<double> weights;
  for (const double known : standard_errors) {
    const double error = std::isfinite(known) ? known : largest;
    weights.push_back(variance > 0 ? variance / (variance + error * error) : 1);
  }
  return weights;
}

ViewTargets view_targets(const ViewDataset& dataset, const Scores& scores, const std::vector<bool>& categories,
                         Target target, TargetScale scale) {
  check_rows(dataset, scores.paths, "scores");
  const bool scaled = scale == TargetScale::scaled;
  ViewTargets targets{.values = scaled && target == Target::individual ? scores.scaled : target_scores(scores, target),
                      .weights = std::vector<double>(dataset.views.size(), 1.0)};
  if (scaled && target == Target::global)
    targets.values = semantics::scaled_per_pose(targets.values, dataset.pose_of_view());
  for (std::size_t v = 0; v < dataset.views.size(); ++v)
    if (!categories[static_cast<std::size_t>(dataset.views[v].category)])
      targets.values[v] = std::numeric_limits<double>::quiet_NaN();
  if (!scaled) centre(dataset, scores, targets);
  return targets;
}

}  // namespace svnet::train
