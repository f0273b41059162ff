#include "train/within_pose.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace svnet::train {
namespace {

constexpr double WithinPose::*kFigures[] = {&WithinPose::spearman, &WithinPose::regret, &WithinPose::better_than_top,
                                            &WithinPose::better_than_rand};

/// Ranks from 0 on; equal values share the mean of their ranks.
std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    for (end = begin; end < order.size() && values[order[end]] == values[order[begin]];) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = static_cast<double>(begin + end - 1) / 2;
  }
  return ranks;
}

}  // namespace

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = static_cast<double>(x.size() - 1) / 2;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

WithinPose within_one_pose(std::span<const double> predicted, std::span<const double> scores,
                           std::optional<std::size_t> top) {
  if (scores.size() < 3) return mean_of({});
  const double chosen =
      scores[static_cast<std::size_t>(std::max_element(predicted.begin(), predicted.end()) - predicted.begin())];
  const double mean = std::accumulate(scores.begin(), scores.end(), 0.0) / static_cast<double>(scores.size());
  return {.poses = 1,
          .spearman = rank_correlation(predicted, scores),
          .regret = *std::max_element(scores.begin(), scores.end()) - chosen,
          .better_than_top = top && chosen > scores[*top] ? 1.0 : 0.0,
          .better_than_rand = chosen > mean ? 1.0 : 0.0};
}

WithinPose within_pose(const ViewDataset& dataset, std::span<const double> predicted, std::span<const double> scores,
                       const std::vector<bool>& categories) {
  std::vector<WithinPose> poses;
  for (const auto& pose : dataset.poses) {
    if (!categories[static_cast<std::size_t>(pose.category)]) continue;
    std::vector<double> x, y;
    std::optional<std::size_t> top;
    for (Index v = pose.first_view; v < pose.first_view + pose.view_count; ++v) {
      const auto view = static_cast<std::size_t>(v);
      if (!std::isfinite(scores[view])) continue;
      if (v == pose.top_view) top = y.size();
      x.push_back(predicted[view]);
      y.push_back(scores[view]);
    }
    poses.push_back(within_one_pose(x, y, top));
  }
  return mean_of(poses);
}

WithinPose mean_of(std::span<const WithinPose> groups) {
  WithinPose sums;
  for (const WithinPose& group : groups) {
    if (group.poses == 0) continue;
    sums.poses += group.poses;
    for (const auto figure : kFigures) sums.*figure += group.*figure * static_cast<double>(group.poses);
  }
  for (const auto figure : kFigures) sums.*figure /= static_cast<double>(sums.poses);
  return sums;
}

}  // namespace svnet::train
