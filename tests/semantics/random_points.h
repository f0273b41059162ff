#pragma once
#include <numeric>
#include <vector>

#include "base/random.h"
#include "semantics/distances.h"

/// Points (n, dimension) around `groups` centres; ties are improbable.
inline std::vector<float> random_points(svnet::Index n, svnet::Index dimension, svnet::Index groups,
                                        std::uint64_t seed) {
  svnet::RandomStream random(seed, svnet::Stream::shuffle);
  std::vector<double> centres(groups * dimension);
  for (auto& value : centres) value = random.normal();
  std::vector<float> points;
  for (svnet::Index i = 0; i < n; ++i) {
    const svnet::Index group = random.below(static_cast<std::uint32_t>(groups));
    for (svnet::Index d = 0; d < dimension; ++d)
      points.push_back(static_cast<float>(centres[group * dimension + d] + 0.7 * random.normal()));
  }
  return points;
}

inline svnet::semantics::DistanceMatrix distances_of(const std::vector<float>& points, svnet::Index dimension) {
  return svnet::semantics::squared_distances(points.data(), static_cast<svnet::Index>(points.size()) / dimension,
                                             dimension, svnet::Parallel::shared());
}

/// 0, 1, …, n - 1.
inline std::vector<std::int32_t> all_rows(svnet::Index n) {
  std::vector<std::int32_t> rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// The same partition, numbered in order of first appearance.
inline std::vector<std::int32_t> by_first_appearance(const std::vector<std::int32_t>& labels) {
  std::vector<std::int32_t> seen, numbered;
  for (std::int32_t label : labels) {
    std::size_t number = 0;
    while (number < seen.size() && seen[number] != label) ++number;
    if (number == seen.size()) seen.push_back(label);
    numbered.push_back(static_cast<std::int32_t>(number));
  }
  return numbered;
}
