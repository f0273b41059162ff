#include "semantics/score_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"

namespace svnet::semantics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double mean(std::uint64_t sum, std::uint64_t count) { return count == 0 ? kNaN : sum * 0x1p-32 / count; }

}  // namespace

void ScoreSums::add(std::span<const std::int32_t> items, std::uint64_t number, double global,
                    std::span<const double> individual) {
  const std::uint64_t fixed_global = fixed(global), even = 1 - number % 2;
  for (std::size_t i = 0; i < items.size(); ++i) {
    View& view = views[static_cast<std::size_t>(items[i])];
    ++view.count;
    view.global += fixed_global;
    if (std::isnan(individual[i])) continue;
    ++view.individual_count;
    const std::uint64_t score = fixed(individual[i]);
    view.individual += score;
    view.even_count += even;
    view.even += even * score;
    view.individual_squared += fixed(individual[i] * individual[i]);
  }
  ++problems;
}

void ScoreSums::add_and_clear(ScoreSums& other) {
  check(views.size() == other.views.size(), "[scores] sums of ", other.views.size(),
        " views cannot be added to those of ", views.size());
  problems += other.problems;
  other.problems = 0;
  const auto to = values(), from = other.values();
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] += from[i];
    from[i] = 0;
  }
}

double standard_error(const ScoreSums::View& sums) {
  if (sums.individual_count < 2) return kNaN;
  const double n = sums.individual_count;
  const double sum = sums.individual * 0x1p-32;
  const double squares = sums.individual_squared * 0x1p-32;
  const double variance = std::max(0.0, squares - sum * sum / n) / (n - 1);
  return std::sqrt(variance / n);
}

SemanticScores scores_from(const ScoreSums& sums) {
  SemanticScores scores;
  scores.problems = sums.problems;
  for (const auto& view : sums.views) {
    scores.individual.push_back(mean(view.individual, view.individual_count));
    scores.global.push_back(mean(view.global, view.count));
    scores.count.push_back(view.count);
    scores.standard_error.push_back(standard_error(view));
  }
  return scores;
}

std::vector<double> rank_stability(const ScoreSums& sums, std::span<const std::int32_t> pose_of_view) {
  check(sums.views.size() == pose_of_view.size(), "[scores] sums of ", sums.views.size(), " views, but ",
        pose_of_view.size(), " poses");
  struct Halves {
    double even, odd;
  };
  std::map<std::int32_t, std::vector<Halves>> views_of_pose;
  for (std::size_t v = 0; v < sums.views.size(); ++v) {
    const auto& view = sums.views[v];
    const Halves halves{mean(view.even, view.even_count),
                        mean(view.individual - view.even, view.individual_count - view.even_count)};
    if (!std::isnan(halves.even) && !std::isnan(halves.odd)) views_of_pose[pose_of_view[v]].push_back(halves);
  }
  std::map<std::int32_t, double> tau;
  for (const auto& [pose, views] : views_of_pose) {
    if (views.size() < 2) continue;
    double agreed = 0, pairs = 0;
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    for (std::size_t i = 0; i < views.size(); ++i)
      for (std::size_t j = 0; j < i; ++j, ++pairs)
        agreed += sign(views[i].even - views[j].even) * sign(views[i].odd - views[j].odd);
    tau[pose] = agreed / pairs;
  }
  std::vector<double> stability(sums.views.size(), kNaN);
  for (std::size_t v = 0; v < stability.size(); ++v)
    if (const auto found = tau.find(pose_of_view[v]); found != tau.end() && sums.views[v].individual_count > 0)
      stability[v] = found->second;
  return stability;
}

std::vector<double> scaled_per_pose(std::span<const double> scores, std::span<const std::int32_t> pose_of_view) {
  check(scores.size() == pose_of_view.size(), "[scores] ", scores.size(), " scores for ", pose_of_view.size(),
        " views");
  struct Extent {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  };
  std::vector<Extent> extents;
  for (std::size_t v = 0; v < scores.size(); ++v) {
    check(pose_of_view[v] >= 0, "[scores] view ", v, " has pose ", pose_of_view[v], "; poses are numbered from 0");
    if (std::ssize(extents) <= pose_of_view[v]) extents.resize(pose_of_view[v] + 1);
    if (std::isnan(scores[v])) continue;
    auto& extent = extents[pose_of_view[v]];
    extent.lowest = std::min(extent.lowest, scores[v]);
    extent.highest = std::max(extent.highest, scores[v]);
  }
  std::vector<double> scaled(scores.size(), kNaN);
  for (std::size_t v = 0; v < scores.size(); ++v) {
    if (std::isnan(scores[v])) continue;
    const auto [lowest, highest] = extents[pose_of_view[v]];
    scaled[v] = lowest == highest ? 0.5 : (scores[v] - lowest) / (highest - lowest);
  }
  return scaled;
}

}  // namespace svnet::semantics
