#pragma once
#include <span>
#include <vector>

#include "sorting/simulation.h"
#include "train/category_bootstrap.h"

namespace svnet::sorting {

/// Means over the tables of one selector.
struct SelectorSummary {
  double wrong = 0;  ///< objects in wrong bins
  double moves = 0, seconds = 0;
  double fewer_than_first = 0;  ///< objects in wrong bins less than those of the first selector on the same tables
  /// Of fewer_than_first, over tables (percentile bootstrap, 2,000 replicates of Stream::bootstrap). NaN for one table.
  train::Interval interval{};
};

/// One per selector. Throws Error without tables.
std::vector<SelectorSummary> summaries(std::span<const SortedTable> tables, std::uint64_t seed);

/// The 95 % interval of the mean of values that are drawn independently, by the bootstrap of summaries().
train::Interval interval_of_mean(std::span<const double> values, std::uint64_t seed);

}  // namespace svnet::sorting
