#include "semantics/dendrogram.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "semantics/agglomerative.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr Linkage kLinkages[] = {Linkage::ward, Linkage::average, Linkage::complete, Linkage::single};

std::vector<std::int32_t> clustered(Linkage linkage, const DistanceMatrix& distances, Index k) {
  std::vector<std::int32_t> labels(static_cast<std::size_t>(distances.size()));
  Agglomerative(linkage, distances.size()).cluster(distances, all_rows(distances.size()), k, labels);
  return labels;
}

using Items = std::vector<Index>;

/// The height of a merge by the definition of the linkage, from the distances of the items.
double height_of(Linkage linkage, const DistanceMatrix& squared, const Items& a, const Items& b) {
  double sum = 0, lowest = INFINITY, highest = 0, between = 0, within_a = 0, within_b = 0;
  for (const Index i : a)
    for (const Index j : b) {
      const double square = squared(i, j), distance = std::sqrt(square);
      sum += distance;
      between += square;
      lowest = std::min(lowest, distance);
      highest = std::max(highest, distance);
    }
  const auto size_a = static_cast<double>(a.size()), size_b = static_cast<double>(b.size());
  for (const Index i : a)
    for (const Index j : a) within_a += squared(i, j) / 2;
  for (const Index i : b)
    for (const Index j : b) within_b += squared(i, j) / 2;
  switch (linkage) {
    case Linkage::ward: {  // SciPy's: sqrt(2 a b / (a + b)) times the distance of the means
      const double means = between / (size_a * size_b) - within_a / (size_a * size_a) - within_b / (size_b * size_b);
      return std::sqrt(2 * size_a * size_b / (size_a + size_b) * means);
    }
    case Linkage::average:
      return sum / (size_a * size_b);
    case Linkage::complete:
      return highest;
    case Linkage::single:
      return lowest;
  }
  return -1;
}

}  // namespace

TEST_CASE("the dendrogram of four points on a line") {
  const DistanceMatrix distances = distances_of({0, 1, 10, 13}, 1);
  const Dendrogram ward = dendrogram(Linkage::ward, distances);
  REQUIRE(ward.items == 4);
  REQUIRE(ward.merges.size() == 3);
  CHECK(ward.merges[0].a == 0);
  CHECK(ward.merges[0].b == 1);
  CHECK(ward.merges[0].height == Approx(1));
  CHECK(ward.merges[0].size == 2);
  CHECK(ward.merges[1].a == 2);
  CHECK(ward.merges[1].b == 3);
  CHECK(ward.merges[1].height == Approx(3));
  CHECK(ward.merges[2].a == 4);
  CHECK(ward.merges[2].b == 5);
  CHECK(ward.merges[2].height == Approx(std::sqrt(2.0) * 11));  // means at 0.5 and 11.5
  CHECK(ward.merges[2].size == 4);
  CHECK(cut(ward, 1) == std::vector<std::int32_t>{0, 0, 0, 0});
  CHECK(cut(ward, 2) == std::vector<std::int32_t>{0, 0, 1, 1});
  CHECK(cut(ward, 3) == std::vector<std::int32_t>{0, 0, 1, 2});
  CHECK(cut(ward, 4) == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(dendrogram(Linkage::average, distances).merges[2].height == Approx((10 + 13 + 9 + 12) / 4.0));
  CHECK(dendrogram(Linkage::complete, distances).merges[2].height == Approx(13));
  CHECK(dendrogram(Linkage::single, distances).merges[2].height == Approx(9));
}

TEST_CASE("a cut of a dendrogram is the partition of agglomerative clustering") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Index n = 1 + static_cast<Index>(seed * 7 % 61);
    // Integer points of few values have many ties.
    std::vector<float> points = random_points(n, 3, 5, seed);
    if (seed % 3 == 0)
      for (float& value : points) value = std::round(value);
    const DistanceMatrix distances = distances_of(points, 3);
    for (const Linkage linkage : kLinkages) {
      const Dendrogram history = dendrogram(linkage, distances);
      for (Index k = 1; k <= n; ++k) {
        INFO(name_of(linkage) << ", seed " << seed << ", " << n << " points, " << k << " clusters");
        REQUIRE(cut(history, k) == clustered(linkage, distances, k));
      }
    }
  }
}

TEST_CASE("heights are the linkage of the merged clusters, and never decrease") {
  constexpr Index kPoints = 70;
  const DistanceMatrix distances = distances_of(random_points(kPoints, 8, 6, 3), 8);
  for (const Linkage linkage : kLinkages) {
    INFO(name_of(linkage));
    const Dendrogram history = dendrogram(linkage, distances);
    std::vector<Items> clusters;
    for (Index i = 0; i < kPoints; ++i) clusters.push_back({i});
    double before = 0;
    for (const Merge& merge : history.merges) {
      const Items a = clusters.at(static_cast<std::size_t>(merge.a)),
                  b = clusters.at(static_cast<std::size_t>(merge.b));
      REQUIRE(merge.a < merge.b);
      REQUIRE(merge.height == Approx(height_of(linkage, distances, a, b)).epsilon(1e-5));
      REQUIRE(merge.height >= before);
      before = merge.height;
      Items both = a;
      both.insert(both.end(), b.begin(), b.end());
      REQUIRE(merge.size == static_cast<Index>(both.size()));
      clusters.push_back(std::move(both));
    }
    CHECK(clusters.back().size() == kPoints);
  }
}

TEST_CASE("dendrograms of one point and of equal points") {
  const Dendrogram one = dendrogram(Linkage::ward, distances_of({3}, 1));
  CHECK(one.merges.empty());
  CHECK(cut(one, 1) == std::vector<std::int32_t>{0});
  const Dendrogram equal = dendrogram(Linkage::ward, distances_of({3, 3, 3}, 1));
  REQUIRE(equal.merges.size() == 2);
  CHECK(equal.merges[1].height == 0);
  CHECK(cut(equal, 2) == std::vector<std::int32_t>{0, 0, 1});
}

TEST_CASE("a dendrogram refuses cuts that are not possible") {
  const Dendrogram history = dendrogram(Linkage::ward, distances_of({0, 1, 5}, 1));
  CHECK_THROWS_WITH(cut(history, 0), "[dendrogram] cannot make 0 clusters of 3 items; 1 to 3 are possible");
  CHECK_THROWS_WITH(cut(history, 4), "[dendrogram] cannot make 4 clusters of 3 items; 1 to 3 are possible");
  CHECK_THROWS_WITH(dendrogram(Linkage::ward, DistanceMatrix(0)), "[dendrogram] there are no points");
}
