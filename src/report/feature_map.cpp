#include "report/feature_map.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "semantics/distances.h"
#include "train/principal_components.h"

namespace svnet::report {
namespace {

std::vector<float> rows_of(const Features& features, const std::vector<Index>& views) {
  std::vector<float> rows;
  rows.reserve(views.size() * static_cast<std::size_t>(features.dimension));
  for (const Index view : views) {
    const auto begin = features.values.begin() + view * features.dimension;
    rows.insert(rows.end(), begin, begin + features.dimension);
  }
  return rows;
}

bool has_two_different(const std::vector<float>& rows, Index dimension) {
  for (std::size_t i = static_cast<std::size_t>(dimension); i < rows.size(); ++i)
    if (rows[i] != rows[i - static_cast<std::size_t>(dimension)]) return true;
  return false;
}

std::vector<ScatterPoint> projected(const std::vector<float>& rows, const train::PrincipalComponents& axes,
                                    const std::vector<std::size_t>& groups) {
  std::vector<ScatterPoint> points;
  for (std::size_t row = 0; row < groups.size(); ++row) {
    double sums[2] = {0, 0};
    for (Index i = 0; i < axes.inputs; ++i) {
      const auto input = static_cast<std::size_t>(i);
      const double value =
          static_cast<double>(rows[row * static_cast<std::size_t>(axes.inputs) + input]) - axes.mean[input];
      for (Index c = 0; c < std::min<Index>(2, axes.components); ++c)
        sums[c] += value * axes.directions[static_cast<std::size_t>(i * axes.components + c)];
    }
    points.push_back({sums[0], sums[1], groups[row]});
  }
  return points;
}

}  // namespace

double mean_silhouette(const std::vector<float>& rows, Index dimension, const std::vector<std::size_t>& groups,
                       Parallel& parallel) {
  const std::size_t count = groups.size(), most = *std::max_element(groups.begin(), groups.end()) + 1;
  if (std::set<std::size_t>(groups.begin(), groups.end()).size() < 2) return std::nan("");
  const semantics::DistanceMatrix squared =
      semantics::squared_distances(rows.data(), static_cast<Index>(count), dimension, parallel);
  std::vector<double> sizes(most);
  for (const std::size_t group : groups) ++sizes[group];
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (sizes[groups[i]] < 2) continue;
    std::vector<double> sums(most);
    for (std::size_t j = 0; j < count; ++j)
      sums[groups[j]] += std::sqrt(static_cast<double>(squared(static_cast<Index>(i), static_cast<Index>(j))));
    double nearest = 1e300;
    for (std::size_t group = 0; group < most; ++group)
      if (group != groups[i] && sizes[group] > 0) nearest = std::min(nearest, sums[group] / sizes[group]);
    const double own = sums[groups[i]] / (sizes[groups[i]] - 1), larger = std::max(own, nearest);
    if (larger > 0) total += (nearest - own) / larger;
  }
  return total / static_cast<double>(count);
}

std::optional<FeatureMap> feature_map(const ViewDataset& dataset, const Features& features, const MappedViews& views,
                                      std::uint64_t seed, Parallel& parallel) {
  if (views.top.size() < 3) return {};
  const std::vector<float> top = rows_of(features, views.top), chosen = rows_of(features, views.chosen);
  std::vector<float> all = top;
  all.insert(all.end(), chosen.begin(), chosen.end());
  if (!has_two_different(top, features.dimension) || !has_two_different(chosen, features.dimension)) return {};

  FeatureMap map{
      .backbone = features.backbone, .dimension = features.dimension, .categories = {}, .top = {}, .chosen = {}};
  std::vector<std::size_t> groups;
  for (const Index view : views.top) {
    const std::string& category =
        dataset.categories[static_cast<std::size_t>(dataset.views[static_cast<std::size_t>(view)].category)];
    if (map.categories.empty() || map.categories.back() != category) map.categories.push_back(category);
    groups.push_back(map.categories.size() - 1);
  }
  const train::PrincipalComponents axes = train::principal_components(all, features.dimension, 2, seed, parallel);
  map.top = projected(top, axes, groups);
  map.chosen = projected(chosen, axes, groups);
  map.top_silhouette = mean_silhouette(top, features.dimension, groups, parallel);
  map.chosen_silhouette = mean_silhouette(chosen, features.dimension, groups, parallel);
  return map;
}

}  // namespace svnet::report
