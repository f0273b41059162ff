#include "semantics/score_sums.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ScoreSums::View sums_of(const std::vector<double>& scores) {
  ScoreSums::View sums;
  for (double score : scores) {
    ++sums.count;
    ++sums.individual_count;
    sums.individual += ScoreSums::fixed(score);
    sums.individual_squared += ScoreSums::fixed(score * score);
    sums.global += ScoreSums::fixed(1 - score);
  }
  return sums;
}

}  // namespace

TEST_CASE("means and standard errors equal those of the scores") {
  RandomStream random(61, Stream::shuffle);
  std::vector<double> values(1000);
  double mean = 0, squares = 0;
  for (auto& value : values) mean += (value = random.uniform()) / 1000;
  for (double value : values) squares += (value - mean) * (value - mean);
  ScoreSums sums(4);
  sums.views[0] = sums_of(values);
  sums.views[1] = sums_of({1, 1, 1});
  sums.views[2] = sums_of({0.25});
  const SemanticScores scores = scores_from(sums);
  CHECK(scores.individual[0] == Approx(mean).epsilon(0).margin(1e-9));
  CHECK(scores.global[0] == Approx(1 - mean).epsilon(0).margin(1e-9));
  CHECK(scores.standard_error[0] == Approx(std::sqrt(squares / 999 / 1000)).epsilon(1e-6));
  CHECK(scores.count == std::vector<std::uint64_t>{1000, 3, 1, 0});
  CHECK(scores.individual[1] == 1);
  CHECK(scores.standard_error[1] == 0);
  CHECK(scores.individual[2] == 0.25);
  CHECK(std::isnan(scores.standard_error[2]));
  for (double value : {scores.individual[3], scores.global[3], scores.standard_error[3]}) CHECK(std::isnan(value));
}

TEST_CASE("sums of parts add up to the sums of the whole, and added sums are zero afterwards") {
  ScoreSums whole(2), left(2), right(2);
  whole.views[1] = sums_of({0.1, 0.2, 0.3, 0.7});
  left.views[1] = sums_of({0.7, 0.1});
  right.views[1] = sums_of({0.3, 0.2});
  whole.problems = 9;
  left.problems = 4;
  right.problems = 5;
  left.add_and_clear(right);
  CHECK(left == whole);
  CHECK(right == ScoreSums(2));
  ScoreSums other(3);
  CHECK_THROWS_WITH(left.add_and_clear(other), "[scores] sums of 3 views cannot be added to those of 2");
}

TEST_CASE("rank stability is the agreement of both halves on pairs of views") {
  ScoreSums sums(6);
  const auto set = [&](std::size_t view, double even, double odd) {
    auto& v = sums.views[view];
    v.count = v.individual_count = 2;
    v.even_count = 1;
    v.even = ScoreSums::fixed(even);
    v.individual = v.even + ScoreSums::fixed(odd);
  };
  set(0, 0.1, 0.2);
  set(1, 0.3, 0.1);  // the halves order 0 and 1 differently
  set(2, 0.9, 0.8);
  set(3, 0.5, 0.5);
  set(4, 0.6, 0.7);
  const std::vector<std::int32_t> pose{0, 0, 0, 1, 1, 1};
  const auto stability = rank_stability(sums, pose);
  for (const std::size_t view : {0, 1, 2}) CHECK(stability[view] == Approx(1.0 / 3));
  for (const std::size_t view : {3, 4}) CHECK(stability[view] == 1);
  CHECK(std::isnan(stability[5]));                                                          // no score at all
  CHECK(std::isnan(rank_stability(sums, std::vector<std::int32_t>{0, 0, 0, 1, 2, 2})[3]));  // alone in its pose
  CHECK_THROWS_WITH(rank_stability(sums, std::vector<std::int32_t>{0}), "[scores] sums of 6 views, but 1 poses");
}

TEST_CASE("scores are scaled to [0, 1] among the views of each pose") {
  const std::vector<double> scores{0.2, 0.5, 0.4, kNaN, 0.9, 0.3, 0.3, kNaN, 0.6};
  const std::vector<std::int32_t> pose{0, 2, 0, 0, 0, 1, 1, 3, 2};
  const auto scaled = scaled_per_pose(scores, pose);
  CHECK(scaled[0] == 0);
  CHECK(scaled[2] == Approx(2.0 / 7));
  CHECK(std::isnan(scaled[3]));
  CHECK(scaled[4] == 1);
  CHECK(scaled[5] == 0.5);
  CHECK(scaled[6] == 0.5);
  CHECK(std::isnan(scaled[7]));
  CHECK(scaled[1] == 0);
  CHECK(scaled[8] == 1);
  CHECK_THROWS_WITH(scaled_per_pose(scores, std::vector<std::int32_t>{0}), "[scores] 9 scores for 1 views");
  CHECK_THROWS_WITH(scaled_per_pose(std::vector<double>{0.5}, std::vector<std::int32_t>{-1}),
                    "[scores] view 0 has pose -1; poses are numbered from 0");
}
