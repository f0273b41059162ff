#include "semantics/distances.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

/// Long double differences: the oracle.
double reference(const std::vector<float>& points, Index dimension, Index i, Index j) {
  long double sum = 0;
  for (Index d = 0; d < dimension; ++d) {
    const long double difference = static_cast<long double>(points[i * dimension + d]) - points[j * dimension + d];
    sum += difference * difference;
  }
  return static_cast<double>(sum);
}

void check_against_reference(const std::vector<float>& points, Index dimension) {
  const DistanceMatrix distances = distances_of(points, dimension);
  double worst = 0;
  bool symmetric = true;
  for (Index i = 0; i < distances.size(); ++i)
    for (Index j = 0; j < distances.size(); ++j) {
      const double expected = reference(points, dimension, i, j);
      worst = std::max(worst, std::abs(distances(i, j) - expected) / std::max(expected, 1e-30));
      symmetric &= distances(i, j) == distances(j, i);
    }
  CHECK(symmetric);
  CHECK(worst < 1.01 * 0x1p-24);  // half a unit in the last place, and 1 % for earlier rounding
}

}  // namespace

TEST_CASE("squared distances equal those in long double, at odd sizes and across tiles") {
  for (auto [n, dimension] : {std::pair<Index, Index>{1, 1}, {2, 3}, {127, 5}, {129, 257}, {300, 7}, {40, 700}})
    check_against_reference(random_points(n, dimension, 4, n), dimension);
}

TEST_CASE("squared distances survive an offset far larger than the differences") {
  auto points = random_points(60, 30, 3, 5);
  for (auto& value : points) value += 4096;
  check_against_reference(points, 30);
}

TEST_CASE("rows that nearly coincide keep their digits, and equal rows have distance 0") {
  const Index dimension = 300;
  auto points = random_points(50, dimension, 3, 6);
  RandomStream random(9, Stream::shuffle);
  std::copy_n(points.begin(), dimension, points.begin() + 20 * dimension);
  for (Index i = 40; i < 50; ++i)
    for (Index d = 0; d < dimension; ++d)
      points[i * dimension + d] = points[d] + 1e-5f * static_cast<float>(random.normal());
  check_against_reference(points, dimension);
  const DistanceMatrix distances = distances_of(points, dimension);
  CHECK(distances(0, 20) == 0);
  CHECK(distances(0, 40) > 0);
  for (Index i = 0; i < 50; ++i) CHECK(distances(i, i) == 0);
}

TEST_CASE("squared distances have the same bits for any number of threads") {
  const auto points = random_points(400, 300, 5, 7);
  Parallel one(1);
  const DistanceMatrix expected = squared_distances(points.data(), 400, 300, one);
  for (int threads : {2, 8}) {
    Parallel pool(threads);
    const DistanceMatrix distances = squared_distances(points.data(), 400, 300, pool);
    for (Index i = 0; i < 400; ++i) REQUIRE(std::memcmp(distances.row(i), expected.row(i), 400 * sizeof(float)) == 0);
  }
}

TEST_CASE("features in double keep differences that float32 cannot hold") {
  const std::vector<double> points{1, 1 + 1e-9, 1 - 2e-9};
  const DistanceMatrix distances = squared_distances(points.data(), 3, 1, Parallel::shared());
  CHECK(distances(0, 1) == Approx(1e-18).epsilon(1e-6));
  CHECK(distances(1, 2) == Approx(9e-18).epsilon(1e-6));
}

TEST_CASE("rows of a distance matrix are 64-byte aligned, small or large") {
  for (Index n : {1, 15, 17, 900}) {
    DistanceMatrix distances(n);
    for (Index i = 0; i < n; ++i) REQUIRE(reinterpret_cast<std::uintptr_t>(distances.row(i)) % 64 == 0);
    CHECK(distances(n - 1, n - 1) == 0);
  }
}

TEST_CASE("squared distances name the wrong row") {
  auto points = random_points(300, 4, 2, 8);
  points[257 * 4 + 2] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH(distances_of(points, 4), "[distances] feature 2 of row 257 is nan; every feature must be finite");
  points[257 * 4 + 2] = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(distances_of(points, 4), "[distances] feature 2 of row 257 is inf; every feature must be finite");
  points[257 * 4 + 2] = 1e30f;
  CHECK_THROWS_WITH(distances_of(points, 4),
                    "[distances] the squared distance of rows 0 and 257 is 1e+60, beyond 1e+30; scale the features "
                    "down");
  CHECK_THROWS_WITH(squared_distances(points.data(), 0, 4, Parallel::shared()),
                    "[distances] features are 0x4; at least 1x1 is needed");
  CHECK_THROWS_WITH(DistanceMatrix(-1), "[distances] -1 rows");
}

TEST_CASE("features whose squared differences vanish in float32 are refused, equal ones are not") {
  const auto tiny = [](float x) { return std::vector<float>{0, 0, x, 0, 10 * x, 0}; };
  CHECK_THAT(distances_of(tiny(1e-14f), 2)(2, 1), Catch::WithinRel(8.1e-27f, 1e-5f));
  CHECK_THROWS_WITH(distances_of(tiny(1e-20f), 2), Catch::StartsWith("[distances] no row is farther than ") &&
                                                       Catch::EndsWith("scale the features up"));
  CHECK(distances_of(std::vector<float>(300, 0.1f), 3)(99, 0) == 0);
}
