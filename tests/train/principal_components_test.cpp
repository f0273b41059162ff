#include "train/principal_components.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/error.h"

using namespace svnet;
using namespace svnet::train;

namespace {

/// Rows with a mean and standard deviations 1, ratio, ratio², … along directions that are not those of the inputs.
std::vector<float> made_up(Index rows, Index inputs, double ratio) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<float> values;
  for (Index row = 0; row < rows; ++row) {
    std::vector<double> x(static_cast<std::size_t>(inputs));
    double sd = 1;
    for (double& value : x) {
      value = sd * normal(random);
      sd *= ratio;
    }
    // A reflection (I - 2 u uᵀ), u of equal entries.
    double sum = 0;
    for (const double value : x) sum += value;
    for (const double value : x)
      values.push_back(static_cast<float>(value - 2 * sum / static_cast<double>(inputs) + 0.5));
  }
  return values;
}

/// The mean over rows of the coordinate products: (components, components).
std::vector<double> second_moments(const PrincipalComponents& c, const std::vector<float>& rows) {
  const auto k = static_cast<std::size_t>(c.components), d = static_cast<std::size_t>(c.inputs);
  std::vector<double> moments(k * k);
  for (std::size_t row = 0; row < rows.size() / d; ++row) {
    std::vector<double> y(k);
    for (std::size_t i = 0; i < d; ++i)
      for (std::size_t j = 0; j < k; ++j)
        y[j] += (static_cast<double>(rows[row * d + i]) - c.mean[i]) * c.directions[i * k + j];
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) moments[i * k + j] += y[i] * y[j] * static_cast<double>(d) / rows.size();
  }
  return moments;
}

}  // namespace

TEST_CASE("components are uncorrelated, in order of variance, and of mean square 1") {
  Parallel parallel(2);
  const std::vector<float> rows = made_up(300, 12, 0.7);
  const PrincipalComponents c = principal_components(rows, 12, 5, 1, parallel);
  REQUIRE(c.components == 5);
  CHECK(c.inputs == 12);
  const auto moments = second_moments(c, rows);
  double trace = 0, scale = moments[0] / c.variances[0];
  for (std::size_t i = 0; i < 5; ++i) {
    trace += moments[i * 5 + i];
    CHECK(moments[i * 5 + i] == Approx(scale * c.variances[i]));
    if (i > 0) CHECK(c.variances[i] < c.variances[i - 1]);
    for (std::size_t j = 0; j < i; ++j) CHECK(std::abs(moments[i * 5 + j]) < 1e-9);
  }
  CHECK(trace / 5 == Approx(1));
  // Near those that the rows were drawn with.
  for (std::size_t i = 0; i < 5; ++i) CHECK(std::sqrt(c.variances[i]) == Approx(std::pow(0.7, i)).epsilon(0.15));
}

TEST_CASE("there are no more components than directions in which the rows vary") {
  Parallel parallel(1);
  CHECK(principal_components(made_up(4, 30, 0.9), 30, 10, 1, parallel).components == 3);
  CHECK(principal_components(made_up(50, 3, 0.9), 3, 10, 1, parallel).components == 3);
  const PrincipalComponents one = principal_components({0, 0, 3, 4}, 2, 2, 1, parallel);
  REQUIRE(one.components == 1);
  CHECK(one.variances[0] == Approx(6.25));
  CHECK(one.mean == std::vector<double>{1.5, 2});
  CHECK(one.directions[0] == Approx(0.6 / 2.5));
  CHECK(one.directions[1] == Approx(0.8 / 2.5));
}

TEST_CASE("of many directions the first components keep nearly all the variance that they can") {
  Parallel parallel(2);
  const std::vector<float> rows = made_up(400, 300, 0.99);
  const PrincipalComponents some = principal_components(rows, 300, 20, 1, parallel),
                            exact = principal_components(rows, 300, 300, 1, parallel);
  double kept = 0, best = 0;
  for (std::size_t i = 0; i < 20; ++i) {
    kept += some.variances[i];
    best += exact.variances[i];
    CHECK(some.variances[i] <= exact.variances[i] * (1 + 1e-12));
  }
  CHECK(kept > 0.999 * best);
}

TEST_CASE("components have the same bits for any number of threads") {
  const std::vector<float> rows = made_up(300, 400, 0.99);
  Parallel one(1), three(3);
  const PrincipalComponents a = principal_components(rows, 400, 30, 1, one),
                            b = principal_components(rows, 400, 30, 1, three);
  CHECK(a.directions == b.directions);
  CHECK(a.mean == b.mean);
  CHECK(a.variances == b.variances);
}

TEST_CASE("rows that do not vary, or are none, are refused") {
  Parallel parallel(1);
  CHECK_THROWS_WITH(principal_components({1, 2, 1, 2}, 2, 1, 1, parallel), "[components] the 2 rows are all the same");
  CHECK_THROWS_WITH(principal_components({}, 2, 1, 1, parallel), "[components] 0 values are no rows of 2");
  CHECK_THROWS_WITH(principal_components({1, 2, 3}, 2, 1, 1, parallel), "[components] 3 values are no rows of 2");
}
