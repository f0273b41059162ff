#include "semantics/score_sums.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"

using namespace svnet;

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

TEST_CASE("means and standard errors are those of the scores") {
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

TEST_CASE("sums of parts are the sums of the whole, and taking leaves nothing") {
  ScoreSums whole(2), left(2), right(2);
  whole.views[1] = sums_of({0.1, 0.2, 0.3, 0.7});
  left.views[1] = sums_of({0.7, 0.1});
  right.views[1] = sums_of({0.3, 0.2});
  whole.problems = 9;
  left.problems = 4;
  right.problems = 5;
  left.take(right);
  CHECK(left == whole);
  CHECK(right == ScoreSums(2));
  ScoreSums other(3);
  CHECK_THROWS_WITH(left.take(other), "[scores] sums of 3 views cannot be added to those of 2");
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
