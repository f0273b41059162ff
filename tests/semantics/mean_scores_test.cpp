#include "semantics/mean_scores.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet;
using namespace svnet::semantics;

TEST_CASE("the mean of scores: counts are the smallest, and a view without a score in one has none") {
  const double none = std::nan("");
  const SemanticScores scores[] = {{.individual = {0.25, 0.5, none},
                                    .global = {0.5, 0.75, none},
                                    .count = {10, 30, 0},
                                    .standard_error = {0.01, 0.02, none},
                                    .problems = 100},
                                   {.individual = {0.75, none, none},
                                    .global = {0.25, 0.25, none},
                                    .count = {20, 20, 0},
                                    .standard_error = {0.03, none, none},
                                    .problems = 80}};
  const SemanticScores mean = mean_scores(scores);
  CHECK(mean.individual[0] == 0.5);
  CHECK(mean.global[0] == 0.375);
  CHECK(mean.standard_error[0] == Approx(0.02).epsilon(1e-15));
  CHECK(std::isnan(mean.individual[1]));
  CHECK(mean.global[1] == 0.5);
  CHECK(std::isnan(mean.global[2]));
  CHECK(mean.count == std::vector<std::uint64_t>{10, 20, 0});
  CHECK(mean.problems == 80);
  CHECK(mean_scores(std::span(scores, 1)).global[0] == 0.5);
}

TEST_CASE("scores of different views have no mean") {
  SemanticScores one{.individual = {1}, .global = {1}, .count = {1}, .standard_error = {0}, .problems = 1}, none;
  const SemanticScores different[] = {one, none};
  CHECK_THROWS_WITH(mean_scores(different), "[scores] the mean of scores of 1 and of 0 views");
  CHECK_THROWS_WITH(mean_scores({}), "[scores] the mean of no scores");
}
