#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.h"
#include "base/parallel.h"

namespace svnet::train {

/// A 95 % interval; NaN if it cannot be told.
struct Interval {
  double low = 0, high = 0;
};

/// Values of clustering problems, and the categories that each problem has.
struct ProblemValues {
  Index columns = 0;
  std::vector<double> values;               ///< (problems, columns)
  std::vector<std::int32_t> categories;     ///< the categories of all problems, one problem after the other
  std::vector<std::size_t> first_category;  ///< (problems + 1) where the categories of a problem begin

  Index problems() const { return static_cast<Index>(first_category.size()) - 1; }
  std::span<const std::int32_t> categories_of(Index problem) const {
    const auto p = static_cast<std::size_t>(problem);
    return std::span(categories).subspan(first_category[p], first_category[p + 1] - first_category[p]);
  }
};

struct BootstrapOptions {
  Index replicates = 1000;
  std::uint64_t seed = 0;
};

/// How far the means of the columns would move with other categories of the same kind (Efron and Tibshirani, "An
/// Introduction to the Bootstrap", 1993, percentile intervals). A replicate draws as many categories as the problems
/// have, with replacement; a problem weighs the product of how often each of its categories was drawn, divided by
/// the product to be expected for as many categories. Replicates in which every weight is 0 do not count. Returns an
/// interval per column; NaN with fewer than 3 categories, and if every problem has all categories, since nothing then
/// tells categories apart. The result has the same bits for any number of threads.
std::vector<Interval> category_intervals(const ProblemValues& values, const BootstrapOptions& options,
                                         Parallel& parallel);

}  // namespace svnet::train
