#pragma once
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "data/features.h"
#include "data/view_dataset.h"
#include "report/run_report.h"

namespace svnet::report {

/// The views of the poses of a map, an index per pose.
struct MappedViews {
  std::vector<Index> top, chosen;
};

/// The features of both sets of views in the principal components of all of them, and how far categories lie apart in
/// each. Nothing if there are fewer than 3 poses, or if all features are equal.
std::optional<FeatureMap> feature_map(const ViewDataset& dataset, const Features& features, const MappedViews& views,
                                      std::uint64_t seed, Parallel& parallel);

/// The mean silhouette (Rousseeuw 1987) of rows (n, dimension) in their groups, by Euclidean distances. Rows that are
/// alone in their group count 0. NaN with fewer than 2 groups.
double mean_silhouette(const std::vector<float>& rows, Index dimension, const std::vector<std::size_t>& groups,
                       Parallel& parallel);

}  // namespace svnet::report
