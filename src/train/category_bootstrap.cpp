#include "train/category_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantile.h"
#include "base/random.h"

namespace svnet::train {
namespace {

/// The categories of the problems, each once, ascending.
std::vector<std::int32_t> distinct_categories(const ProblemValues& values) {
  std::vector<std::int32_t> categories = values.categories;
  std::sort(categories.begin(), categories.end());
  categories.erase(std::unique(categories.begin(), categories.end()), categories.end());
  return categories;
}

/// `count`: of all categories.
bool each_problem_has_all(const ProblemValues& values, std::size_t count) {
  for (Index p = 0; p < values.problems(); ++p)
    if (values.categories_of(p).size() < count) return false;
  return true;
}

/// The expected product of how often each of `size` different ones of `count` categories is drawn in `count` draws.
/// Without a division by it, problems of few categories would weigh more than those of many.
double expected_weight(std::size_t size, std::size_t count) {
  double weight = 1;
  for (std::size_t i = 0; i < size; ++i) weight *= static_cast<double>(count - i) / static_cast<double>(count);
  return weight;
}

/// The weighted means of the columns in one replicate, or NaN if every weight is 0.
void replicate_means(const ProblemValues& values, const std::vector<double>& drawn, std::size_t categories,
                     std::span<double> means) {
  std::fill(means.begin(), means.end(), 0.0);
  double sum = 0;
  for (Index p = 0; p < values.problems(); ++p) {
    double weight = 1;
    for (const std::int32_t category : values.categories_of(p)) weight *= drawn[static_cast<std::size_t>(category)];
    if (weight == 0) continue;
    weight /= expected_weight(values.categories_of(p).size(), categories);
    sum += weight;
    const double* row = values.values.data() + p * values.columns;
    for (std::size_t c = 0; c < means.size(); ++c) means[c] += weight * row[c];
  }
  for (double& mean : means) mean = sum > 0 ? mean / sum : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<Interval> category_intervals(const ProblemValues& values, const BootstrapOptions& options,
                                         Parallel& parallel) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto columns = static_cast<std::size_t>(values.columns);
  const std::vector<std::int32_t> categories = distinct_categories(values);
  if (categories.size() < 3 || each_problem_has_all(values, categories.size()))
    return std::vector<Interval>(columns, {kNaN, kNaN});

  std::vector<double> means(static_cast<std::size_t>(options.replicates) * columns);
  parallel.for_chunks(options.replicates, 1, [&](Index begin, Index end, int) {
    std::vector<double> drawn(static_cast<std::size_t>(categories.back()) + 1);
    for (Index replicate = begin; replicate < end; ++replicate) {
      RandomStream random(options.seed, Stream::bootstrap, static_cast<std::uint64_t>(replicate));
      std::fill(drawn.begin(), drawn.end(), 0.0);
      for (std::size_t i = 0; i < categories.size(); ++i)
        drawn[static_cast<std::size_t>(categories[random.below(static_cast<std::uint32_t>(categories.size()))])] += 1;
      replicate_means(values, drawn, categories.size(),
                      std::span(means).subspan(static_cast<std::size_t>(replicate) * columns, columns));
    }
  });

  std::vector<Interval> intervals;
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<double> column;
    for (std::size_t i = c; i < means.size(); i += columns)
      if (!std::isnan(means[i])) column.push_back(means[i]);
    std::sort(column.begin(), column.end());
    intervals.push_back(column.empty() ? Interval{kNaN, kNaN}
                                       : Interval{quantile(column, 0.025), quantile(column, 0.975)});
  }
  return intervals;
}

}  // namespace svnet::train
