#include "semantics/agglomerative.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <tuple>

#include "base/cpu.h"
#include "base/error.h"
#include "semantics/allocations.h"
#include "semantics/clustering_fixtures.h"
#include "semantics/dendrogram.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr Linkage kLinkages[] = {Linkage::ward, Linkage::average, Linkage::complete, Linkage::single};

struct Points {
  const std::vector<float>& values;
  Index dimension;

  double distance(Index i, Index j) const {
    double sum = 0;
    for (Index d = 0; d < dimension; ++d)
      sum += std::pow(static_cast<double>(values[i * dimension + d]) - values[j * dimension + d], 2);
    return std::sqrt(sum);
  }
};

using Cluster = std::vector<std::int32_t>;

/// The dissimilarity by the definition of the linkage, from the points.
double dissimilarity(Linkage linkage, const Points& points, const Cluster& a, const Cluster& b) {
  if (linkage == Linkage::ward) {
    double sum = 0;
    for (Index d = 0; d < points.dimension; ++d) {
      double mean_a = 0, mean_b = 0;
      for (auto i : a) mean_a += points.values[i * points.dimension + d] / static_cast<double>(a.size());
      for (auto i : b) mean_b += points.values[i * points.dimension + d] / static_cast<double>(b.size());
      sum += (mean_a - mean_b) * (mean_a - mean_b);
    }
    return sum * static_cast<double>(a.size() * b.size()) / static_cast<double>(a.size() + b.size());
  }
  double sum = 0, lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (auto i : a)
    for (auto j : b) {
      const double distance = points.distance(i, j);
      sum += distance;
      lowest = std::min(lowest, distance);
      highest = std::max(highest, distance);
    }
  if (linkage == Linkage::average) return sum / static_cast<double>(a.size() * b.size());
  return linkage == Linkage::single ? lowest : highest;
}

/// The naive algorithm: merges the least dissimilar of all pairs of clusters until k are left.
std::vector<std::int32_t> naive(Linkage linkage, const Points& points, const std::vector<std::int32_t>& rows, Index k) {
  std::vector<Cluster> clusters;
  std::vector<Cluster> positions;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    clusters.push_back({rows[i]});
    positions.push_back({static_cast<std::int32_t>(i)});
  }
  while (static_cast<Index>(clusters.size()) > k) {
    double smallest = std::numeric_limits<double>::infinity();
    std::size_t best_a = 0, best_b = 0;
    for (std::size_t a = 0; a < clusters.size(); ++a)
      for (std::size_t b = a + 1; b < clusters.size(); ++b)
        if (const double d = dissimilarity(linkage, points, clusters[a], clusters[b]); d < smallest) {
          smallest = d;
          best_a = a;
          best_b = b;
        }
    clusters[best_a].insert(clusters[best_a].end(), clusters[best_b].begin(), clusters[best_b].end());
    positions[best_a].insert(positions[best_a].end(), positions[best_b].begin(), positions[best_b].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(best_b));
    positions.erase(positions.begin() + static_cast<std::ptrdiff_t>(best_b));
  }
  std::vector<std::int32_t> labels(rows.size());
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (auto i : positions[c]) labels[i] = static_cast<std::int32_t>(c);
  return labels;  // clusters are in the order of their first points
}

std::vector<std::int32_t> clustered(Linkage linkage, const DistanceMatrix& distances,
                                    const std::vector<std::int32_t>& rows, Index k) {
  std::vector<std::int32_t> labels(rows.size());
  Agglomerative(linkage, static_cast<Index>(rows.size())).cluster(distances, rows, k, labels);
  return labels;
}

/// The distances of points on a line.
DistanceMatrix line(const std::vector<float>& positions) { return distances_of(positions, 1); }

}  // namespace

TEST_CASE("partitions are those of scikit-learn") {
  Index compared = 0;
  for (const auto& points : clustering_fixtures().points) {
    const DistanceMatrix distances = distances_of(points.features, points.dimension);
    for (const auto& partition : points.partitions) {
      INFO(partition.linkage << ", " << points.n << " points, " << partition.k << " clusters");
      CHECK(clustered(linkage_named(partition.linkage), distances, all_rows(points.n), partition.k) ==
            by_first_appearance(partition.labels));
      ++compared;
    }
  }
  CHECK(compared >= 50);
}

namespace {

/// The random numbers of make_partition_fixtures.py.
struct SplitMix64 {
  std::uint64_t state;

  std::uint32_t below(std::uint32_t n) {
    std::uint64_t z = state += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32) % n;
  }
};

std::uint32_t fnv1a(const std::vector<std::int32_t>& labels) {
  std::uint32_t value = 0x811C9DC5;
  for (std::int32_t label : labels) value = (value ^ static_cast<std::uint32_t>(label)) * 0x01000193;
  return value;
}

}  // namespace

TEST_CASE("partitions of 1000 problems are those of scikit-learn, for each linkage") {
  std::ifstream file(SVNET_FIXTURES "/partitions.txt");
  std::uint64_t problem = 0;
  for (std::string line; std::getline(file, line); ++problem) {
    SplitMix64 random{problem};
    const Index n = 5 + random.below(96), dimension = 4 + random.below(29), groups = 1 + random.below(12);
    const Index k = 1 + random.below(static_cast<std::uint32_t>(n));
    std::vector<std::uint32_t> centres(groups * dimension);
    for (auto& value : centres) value = random.below(1 << 16);
    std::vector<float> points;
    for (Index i = 0; i < n; ++i) {
      const std::uint32_t* centre = &centres[random.below(static_cast<std::uint32_t>(groups)) * dimension];
      for (Index d = 0; d < dimension; ++d) points.push_back(static_cast<float>(centre[d] + random.below(1 << 16)));
    }
    std::istringstream words(line);
    Index given_n = 0, given_dimension = 0, given_k = 0;
    words >> given_n >> given_dimension >> given_k >> std::hex;
    REQUIRE(std::tuple(given_n, given_dimension, given_k) == std::tuple(n, dimension, k));
    const DistanceMatrix distances = distances_of(points, dimension);
    for (Linkage linkage : kLinkages) {
      std::uint32_t expected = 0;
      REQUIRE(words >> expected);
      INFO("problem " << problem << ", " << name_of(linkage) << ", " << n << " points, " << k << " clusters");
      CHECK(fnv1a(clustered(linkage, distances, all_rows(n), k)) == expected);
    }
  }
  CHECK(problem == 1000);
}

TEST_CASE("every linkage agrees with the naive algorithm on subsets of rows in any order") {
  const Index n = 60, dimension = 6;
  const auto values = random_points(n, dimension, 6, 21);
  const DistanceMatrix distances = distances_of(values, dimension);
  RandomStream random(22, Stream::shuffle);
  for (Linkage linkage : kLinkages) {
    Agglomerative workspace(linkage, 40);
    for (int repeat = 0; repeat < 40; ++repeat) {
      auto rows = all_rows(n);
      const Index count = 1 + random.below(40);
      draw_without_replacement(random, rows.data(), n, count);
      rows.resize(count);
      const Index k = 1 + random.below(static_cast<std::uint32_t>(count));
      std::vector<std::int32_t> labels(count);
      workspace.cluster(distances, rows, k, labels);
      INFO(name_of(linkage) << ", " << count << " points, " << k << " clusters");
      REQUIRE(labels == naive(linkage, {values, dimension}, rows, k));
    }
  }
}

TEST_CASE("average linkage averages distances, not their squares") {
  DistanceMatrix distances(4);
  const auto set = [&](Index i, Index j, float distance) {
    distances.row(i)[j] = distances.row(j)[i] = distance * distance;
  };
  set(0, 1, 3);
  set(0, 2, 3.1f);
  set(1, 2, 6);
  set(2, 3, 4.65f);
  set(0, 3, 7);
  set(1, 3, 7);
  // {0, 1} to 2 has the mean 4.55 < 4.65, but the mean square 4.775².
  CHECK(clustered(Linkage::average, distances, {0, 1, 2, 3}, 2) == std::vector<std::int32_t>{0, 0, 0, 1});
}

TEST_CASE("in a tie the pair with the lowest clusters is merged") {
  const DistanceMatrix equal = line({0, 1, 2, 3, 4, 5});
  for (Linkage linkage : kLinkages)
    CHECK(clustered(linkage, equal, {0, 1, 2, 3, 4, 5}, 5) == std::vector<std::int32_t>{0, 0, 1, 2, 3, 4});
  // After {0, 1}: single linkage is tied between {0, 1}-2 and 2-3; the pair with the lower cluster is merged first.
  CHECK(clustered(Linkage::single, equal, {0, 1, 2, 3, 4, 5}, 4) == std::vector<std::int32_t>{0, 0, 0, 1, 2, 3});
  CHECK(clustered(Linkage::complete, equal, {0, 1, 2, 3, 4, 5}, 3) == std::vector<std::int32_t>{0, 0, 1, 1, 2, 2});
  // Slots hold the positions 5 3 4 0 1 2: {5, 4}, then 3, 2 and 1 join, each time before the equal pair {0, 1}.
  CHECK(clustered(Linkage::single, equal, {5, 3, 4, 0, 1, 2}, 2) == std::vector<std::int32_t>{0, 0, 0, 1, 0, 0});
  // 1 and 3 are merged first. Then 0 is as near to them as to 2, its nearest slot so far.
  CHECK(clustered(Linkage::single, line({0, 3, -2, 2}), {0, 1, 2, 3}, 2) == std::vector<std::int32_t>{0, 0, 1, 0});
  const DistanceMatrix same = line({7, 7, 7, 7});
  CHECK(clustered(Linkage::ward, same, {0, 1, 2, 3}, 2) == std::vector<std::int32_t>{0, 0, 0, 1});
}

TEST_CASE("every instruction set gives the same partitions, with ties too, and the same distances up to the last bit") {
  const Index n = 70, dimension = 5;
  auto values = random_points(n, dimension, 5, 25);
  for (auto& value : values) value = std::round(2 * value);  // many equal distances
  const DistanceMatrix expected = distances_of(values, dimension);
  const auto sets = instruction_sets();
  std::vector<std::vector<std::int32_t>> partitions;
  for (const auto& set : sets) {
    INFO(set);
    cap_instruction_set(set);
    const DistanceMatrix distances = distances_of(values, dimension);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) REQUIRE(distances(i, j) == Approx(expected(i, j)).epsilon(1e-7));
    std::vector<std::int32_t> all;
    for (Linkage linkage : kLinkages)
      for (Index k : {1, 2, 9, 40}) {
        const auto labels = clustered(linkage, expected, all_rows(n), k);
        all.insert(all.end(), labels.begin(), labels.end());
      }
    partitions.push_back(all);
    CHECK(partitions.back() == partitions.front());
  }
  cap_instruction_set(sets.front());
}

TEST_CASE("every instruction set cuts the dendrogram, with ties and more slots than vectors that are unrolled") {
  const auto sets = instruction_sets();
  for (const auto& set : sets) {
    cap_instruction_set(set);
    for (const Index n : {2, 15, 33, 65, 131, 200})
      for (const bool ties : {false, true}) {
        auto values = random_points(n, 3, 7, static_cast<std::uint64_t>(27 + n));
        if (ties)
          for (auto& value : values) value = std::round(value);
        const DistanceMatrix distances = distances_of(values, 3);
        for (Linkage linkage : kLinkages) {
          const Dendrogram history = dendrogram(linkage, distances);
          for (Index k = 1; k <= n; k += 1 + n / 9) {
            INFO(set << ", " << name_of(linkage) << ", " << n << " points, " << k << " clusters, ties " << ties);
            REQUIRE(clustered(linkage, distances, all_rows(n), k) == cut(history, k));
          }
        }
      }
  }
  cap_instruction_set(sets.front());
}

TEST_CASE("agglomerative clustering ignores the padding of a triangle") {
  const Index n = 37;
  const DistanceMatrix distances = distances_of(random_points(n, 4, 5, 26), 4);
  std::vector<std::int32_t> labels(n);
  for (Linkage linkage : kLinkages)
    for (const float padding : {0.0f, -1e30f, std::nanf("")}) {
      AlignedArray<float> values(static_cast<std::size_t>(LowerTriangle::size(n)));
      std::fill_n(values.data(), LowerTriangle::size(n), padding);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < i; ++j) values[LowerTriangle::row_offset(i) + j] = distances(i, j);
      Agglomerative(linkage, n).cluster(LowerTriangle{values.data(), n}, 6, labels);
      CHECK(labels == clustered(linkage, distances, all_rows(n), 6));
    }
}

TEST_CASE("agglomerative clustering allocates nothing") {
  const DistanceMatrix distances = distances_of(random_points(30, 3, 3, 23), 3);
  const auto rows = all_rows(30);
  std::vector<std::int32_t> labels(30);
  for (Linkage linkage : kLinkages) {
    Agglomerative workspace(linkage, 30);
    const std::size_t before = allocations();
    for (Index k = 1; k <= 30; ++k) workspace.cluster(distances, rows, k, labels);
    CHECK(allocations() == before);
  }
}

TEST_CASE("linkages have names") {
  for (Linkage linkage : kLinkages) CHECK(linkage_named(name_of(linkage)) == linkage);
  CHECK_THROWS_WITH(linkage_named("wart"), Catch::Contains("[linkage] 'wart' is unknown, did you mean 'ward'?"));
}

TEST_CASE("agglomerative clustering refuses an impossible number of clusters") {
  const DistanceMatrix distances = line({0, 1, 2});
  CHECK_THROWS_WITH(clustered(Linkage::ward, distances, {0, 1, 2}, 0),
                    "[agglomerative] cannot make 0 clusters of 3 points; 1 to 3 are possible");
  CHECK_THROWS_WITH(clustered(Linkage::ward, distances, {0, 1, 2}, 4),
                    "[agglomerative] cannot make 4 clusters of 3 points; 1 to 3 are possible");
  Agglomerative small(Linkage::ward, 2);
  std::vector<std::int32_t> labels(3);
  CHECK_THROWS_WITH(small.cluster(distances, all_rows(3), 1, labels),
                    "[agglomerative] 3 points, but memory was made for 2");
  labels.resize(1);
  CHECK_THROWS_WITH(small.cluster(distances, std::vector<std::int32_t>{0, 1}, 1, labels),
                    "[agglomerative] 1 labels for 2 points");
}
