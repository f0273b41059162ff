#include "semantics/kmeans.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "base/error.h"
#include "semantics/allocations.h"
#include "semantics/clustering_fixtures.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

RandomStream stream(std::uint64_t index) { return {31, Stream::kmeans, index}; }

/// The sum of squared distances to the means of the clusters, computed from the points.
double inertia_of(const std::vector<float>& points, Index dimension, const std::vector<std::int32_t>& labels) {
  double inertia = 0;
  for (std::int32_t label : std::set<std::int32_t>(labels.begin(), labels.end()))
    for (Index d = 0; d < dimension; ++d) {
      double sum = 0, squares = 0, count = 0;
      for (std::size_t i = 0; i < labels.size(); ++i)
        if (labels[i] == label) {
          const double value = points[i * dimension + d];
          sum += value;
          squares += value * value;
          ++count;
        }
      inertia += squares - sum * sum / count;
    }
  return inertia;
}

}  // namespace

TEST_CASE("a k-means run from given centres equals scikit-learn's") {
  Index compared = 0;
  for (const auto& points : clustering_fixtures().points) {
    const DistanceMatrix distances = distances_of(points.features, points.dimension);
    for (const auto& run : points.runs) {
      const auto k = static_cast<Index>(run.initial.size());
      KMeans kmeans(points.n, k, points.dimension, {.max_iterations = run.max_iterations, .tolerance = run.tolerance});
      std::vector<std::int32_t> labels(points.n);
      const double inertia = kmeans.run_from(distances, all_rows(points.n), run.initial, labels);
      INFO(points.n << " points, " << k << " clusters, tolerance " << run.tolerance << ", " << run.max_iterations
                    << " iterations");
      CHECK(labels == run.labels);
      CHECK(inertia == Approx(run.inertia).epsilon(1e-6));
      ++compared;
    }
  }
  CHECK(compared >= 12);
}

TEST_CASE("the best of many k-means runs has scikit-learn's inertia") {
  Index compared = 0;
  for (const auto& points : clustering_fixtures().points) {
    const DistanceMatrix distances = distances_of(points.features, points.dimension);
    for (const auto& best : points.best) {
      KMeans kmeans(points.n, best.k, points.dimension, {.n_init = 300});
      std::vector<std::int32_t> labels(points.n);
      const double inertia = kmeans.cluster(distances, all_rows(points.n), best.k, stream(0), labels);
      INFO(points.n << " points, " << best.k << " clusters");
      CHECK(inertia == Approx(best.inertia).epsilon(1e-6));
      CHECK(inertia == Approx(inertia_of(points.features, points.dimension, labels)).epsilon(1e-6));
      CHECK(labels == by_first_appearance(labels));
      ++compared;
    }
  }
  CHECK(compared >= 5);
}

TEST_CASE("the start of k-means is on average as good as scikit-learn's") {
  Index compared = 0;
  for (const auto& points : clustering_fixtures().points)
    for (const auto& single : points.single) {
      const DistanceMatrix distances = distances_of(points.features, points.dimension);
      KMeans kmeans(points.n, single.k, points.dimension, {.n_init = 1, .max_iterations = 1});
      std::vector<std::int32_t> labels(points.n);
      const int runs = 20000;
      double sum = 0, squares = 0;
      for (int run = 0; run < runs; ++run) {
        const double inertia = kmeans.cluster(distances, all_rows(points.n), single.k, stream(run), labels);
        sum += inertia;
        squares += inertia * inertia;
      }
      const double mean = sum / runs, deviation = std::sqrt(squares / runs - mean * mean);
      const double error = std::hypot(deviation / std::sqrt(runs),
                                      single.standard_deviation / std::sqrt(static_cast<double>(single.runs)));
      CHECK(std::abs(mean - single.mean) < 4 * error);
      CHECK(deviation == Approx(single.standard_deviation).epsilon(0.1));
      ++compared;
    }
  CHECK(compared >= 1);
}

TEST_CASE("more k-means runs are never worse, and the random stream determines the result") {
  const auto points = random_points(50, 5, 8, 32);
  const DistanceMatrix distances = distances_of(points, 5);
  const auto rows = all_rows(50);
  std::vector<std::int32_t> labels(50), again(50);
  double before = 1e300;
  for (Index n_init : {1, 2, 5, 20}) {
    KMeans kmeans(50, 8, 5, {.n_init = n_init});
    const double inertia = kmeans.cluster(distances, rows, 8, stream(3), labels);
    CHECK(inertia <= before);
    before = inertia;
    CHECK(kmeans.cluster(distances, rows, 8, stream(3), again) == inertia);
    CHECK(labels == again);
  }
  KMeans once(50, 8, 5, {.n_init = 1});
  std::set<double> inertias;
  for (std::uint64_t index = 0; index < 20; ++index)
    inertias.insert(once.cluster(distances, rows, 8, stream(index), labels));
  CHECK(inertias.size() > 3);
}

TEST_CASE("k-means handles as many clusters as points, one cluster, and points that coincide") {
  const auto points = random_points(12, 2, 3, 33);
  const DistanceMatrix distances = distances_of(points, 2);
  std::vector<std::int32_t> labels(12);
  KMeans kmeans(12, 12, 2);
  CHECK(kmeans.cluster(distances, all_rows(12), 12, stream(0), labels) == Approx(0).margin(1e-12));
  CHECK(labels == all_rows(12));
  CHECK(kmeans.cluster(distances, all_rows(12), 1, stream(0), labels) ==
        Approx(inertia_of(points, 2, std::vector<std::int32_t>(12, 0))).epsilon(1e-6));
  CHECK(labels == std::vector<std::int32_t>(12, 0));

  const DistanceMatrix same = distances_of({1, 1, 1, 5, 5, 5}, 1);
  labels.resize(6);
  KMeans of_six(6, 4, 1);
  CHECK(of_six.cluster(same, all_rows(6), 2, stream(0), labels) == 0);
  CHECK(labels == std::vector<std::int32_t>{0, 0, 0, 1, 1, 1});
  CHECK(of_six.cluster(same, all_rows(6), 4, stream(0), labels) == 0);  // fewer distinct points than clusters
  CHECK(labels == std::vector<std::int32_t>{0, 0, 0, 1, 1, 1});
}

TEST_CASE("k-means ignores the padding of a triangle") {
  const Index n = 37;
  const DistanceMatrix distances = distances_of(random_points(n, 4, 5, 35), 4);
  std::vector<std::int32_t> expected(n), labels(n);
  KMeans kmeans(n, 6, 4, {.n_init = 3});
  const double inertia = kmeans.cluster(distances, all_rows(n), 6, stream(1), expected);
  for (const float padding : {0.0f, -1e30f, std::nanf("")}) {
    AlignedArray<float> values(static_cast<std::size_t>(LowerTriangle::size(n)));
    std::fill_n(values.data(), LowerTriangle::size(n), padding);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < i; ++j) values[LowerTriangle::row_offset(i) + j] = distances(i, j);
    CHECK(kmeans.cluster(LowerTriangle{values.data(), n}, 6, stream(1), labels) == inertia);
    CHECK(labels == expected);
  }
}

TEST_CASE("k-means allocates nothing") {
  const DistanceMatrix distances = distances_of(random_points(30, 3, 3, 34), 3);
  const auto rows = all_rows(30);
  std::vector<std::int32_t> labels(30);
  KMeans kmeans(30, 30, 3);
  const std::size_t before = allocations();
  for (Index k = 1; k <= 30; ++k) kmeans.cluster(distances, rows, k, stream(k), labels);
  CHECK(allocations() == before);
}

TEST_CASE("k-means refuses impossible arguments") {
  const DistanceMatrix distances = distances_of({0, 1, 2}, 1);
  std::vector<std::int32_t> labels(3);
  KMeans kmeans(3, 2, 1);
  CHECK_THROWS_WITH(kmeans.cluster(distances, all_rows(3), 0, stream(0), labels),
                    "[kmeans] cannot make 0 clusters of 3 points; 1 to 3 are possible");
  CHECK_THROWS_WITH(kmeans.cluster(distances, all_rows(3), 4, stream(0), labels),
                    "[kmeans] cannot make 4 clusters of 3 points; 1 to 3 are possible");
  CHECK_THROWS_WITH(kmeans.cluster(distances, all_rows(3), 3, stream(0), labels),
                    "[kmeans] 3 points in 3 clusters, but memory was made for 3 in 2");
  CHECK_THROWS_WITH(kmeans.run_from(distances, all_rows(3), std::vector<std::int32_t>{0, 3}, labels),
                    "[kmeans] initial centre 3 is not one of the 3 points");
  CHECK_THROWS_WITH(KMeans(3, 2, 1, {.n_init = 0}), "[kmeans] n_init is 0; at least 1 is needed");
  CHECK_THROWS_WITH(KMeans(3, 2, 1, {.tolerance = -1}), "[kmeans] tolerance is -1; it must not be negative");
  CHECK_THROWS_WITH(KMeans(3, 2, 1, {.max_iterations = 0}), "[kmeans] max_iterations is 0; at least 1 is needed");
  CHECK_THROWS_WITH(KMeans(3, 2, 0), "[kmeans] the features have dimension 0; at least 1 is needed");
  labels.resize(2);
  CHECK_THROWS_WITH(kmeans.cluster(distances, all_rows(3), 2, stream(0), labels), "[kmeans] 2 labels for 3 points");
}
