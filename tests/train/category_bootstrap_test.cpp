#include "train/category_bootstrap.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"

using namespace svnet;
using namespace svnet::train;

namespace {

/// `problems` problems of three of `categories` categories, with one column: the mean of their categories' values.
ProblemValues problems_of(const std::vector<double>& categories, Index problems) {
  ProblemValues values{.columns = 1, .values = {}, .categories = {}, .first_category = {0}};
  for (Index p = 0; p < problems; ++p) {
    RandomStream random(1, Stream::evaluation, static_cast<std::uint64_t>(p));
    double sum = 0;
    for (std::size_t drawn = 0; drawn < 3;) {
      const auto category = static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(categories.size())));
      const auto begin = values.categories.begin() + static_cast<std::ptrdiff_t>(values.first_category.back());
      if (std::find(begin, values.categories.end(), category) != values.categories.end()) continue;
      values.categories.push_back(category);
      sum += categories[static_cast<std::size_t>(category)];
      ++drawn;
    }
    values.values.push_back(sum / 3);
    values.first_category.push_back(values.categories.size());
  }
  return values;
}

}  // namespace

TEST_CASE("equal values have an interval of no width") {
  Parallel parallel(2);
  const auto intervals = category_intervals(problems_of(std::vector<double>(6, 0.25), 200), {}, parallel);
  CHECK(intervals.at(0).low == Approx(0.25));
  CHECK(intervals.at(0).high == Approx(0.25));
}

TEST_CASE("the interval is about as wide as the spread of category means says") {
  // Means of 20 categories, of standard deviation 1: their mean has the standard error 1 / sqrt(20) = 0.22.
  std::vector<double> categories;
  for (int i = 0; i < 20; ++i) categories.push_back((i % 2 == 0 ? 1 : -1));
  Parallel parallel(2);
  const auto interval = category_intervals(problems_of(categories, 4000), {}, parallel).at(0);
  CHECK(interval.low < 0);
  CHECK(interval.high > 0);
  CHECK((interval.high - interval.low) / 2 == Approx(1.96 * 0.22).epsilon(0.2));
}

TEST_CASE("intervals have the same bits for any number of threads, and differ with the seed") {
  const std::vector<double> categories{0.1, 0.5, 0.2, 0.9, 0.4, 0.3, 0.8};
  const ProblemValues values = problems_of(categories, 500);
  Parallel one(1), three(3);
  const auto a = category_intervals(values, {}, one).at(0), b = category_intervals(values, {}, three).at(0);
  CHECK(a.low == b.low);
  CHECK(a.high == b.high);
  const auto other = category_intervals(values, {.seed = 1}, one).at(0);
  CHECK(other.low != a.low);
}

TEST_CASE("two categories tell no interval") {
  Parallel parallel(1);
  const ProblemValues values{
      .columns = 1, .values = {0.5, 0.7}, .categories = {0, 1, 0, 1}, .first_category = {0, 2, 4}};
  CHECK(std::isnan(category_intervals(values, {}, parallel).at(0).low));
}

TEST_CASE("problems that all have all categories tell no interval") {
  Parallel parallel(1);
  ProblemValues values{
      .columns = 1, .values = {0.5, 0.7}, .categories = {0, 1, 2, 2, 0, 1}, .first_category = {0, 3, 6}};
  CHECK(std::isnan(category_intervals(values, {}, parallel).at(0).low));
  CHECK(std::isnan(category_intervals(values, {}, parallel).at(0).high));
  values = {.columns = 1, .values = {0.5, 0.7}, .categories = {0, 1, 2, 2, 0}, .first_category = {0, 3, 5}};
  CHECK_FALSE(std::isnan(category_intervals(values, {}, parallel).at(0).low));
}
