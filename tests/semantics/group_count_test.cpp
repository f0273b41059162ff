#include "semantics/group_count.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr GroupCount kMethods[] = {GroupCount::height, GroupCount::silhouette, GroupCount::gap};
constexpr Linkage kLinkages[] = {Linkage::ward, Linkage::average, Linkage::complete, Linkage::single};

Index counted(GroupCount method, const DistanceMatrix& distances, Linkage linkage = Linkage::ward) {
  return group_count(method, linkage, dendrogram(linkage, distances), distances);
}

/// The mean silhouette by its definition.
double silhouette_of(const std::vector<std::int32_t>& labels, Index k, const DistanceMatrix& squared) {
  const Index n = squared.size();
  double total = 0;
  for (Index i = 0; i < n; ++i) {
    std::vector<double> sum(static_cast<std::size_t>(k), 0), size(static_cast<std::size_t>(k), 0);
    for (Index j = 0; j < n; ++j)
      if (j != i) {
        sum[static_cast<std::size_t>(labels[static_cast<std::size_t>(j)])] += std::sqrt(squared(i, j));
        ++size[static_cast<std::size_t>(labels[static_cast<std::size_t>(j)])];
      }
    const auto own = static_cast<std::size_t>(labels[static_cast<std::size_t>(i)]);
    if (size[own] == 0) continue;
    double within = sum[own] / size[own], nearest = INFINITY;
    for (std::size_t c = 0; c < sum.size(); ++c)
      if (c != own) nearest = std::min(nearest, sum[c] / size[c]);
    total += (nearest - within) / std::max(nearest, within);
  }
  return total / static_cast<double>(n);
}

/// `groups` groups of `size` points each in 20 dimensions, far apart.
DistanceMatrix clear_groups(Index groups, Index size) {
  RandomStream random(5, Stream::shuffle, 0);
  std::vector<float> points;
  for (Index g = 0; g < groups; ++g)
    for (Index i = 0; i < size; ++i)
      for (Index d = 0; d < 20; ++d) points.push_back(static_cast<float>((d == g ? 40 : 0) + random.normal()));
  return distances_of(points, 20);
}

}  // namespace

TEST_CASE("silhouettes of the cuts of a dendrogram follow their definition") {
  constexpr Index kPoints = 40;
  const DistanceMatrix distances = distances_of(random_points(kPoints, 5, 6, 2), 5);
  for (const Linkage linkage : kLinkages) {
    const Dendrogram history = dendrogram(linkage, distances);
    const std::vector<double> silhouettes = mean_silhouettes(history, distances);
    REQUIRE(silhouettes.size() == kPoints);
    for (Index k = 2; k < kPoints; ++k)
      CHECK(silhouettes[static_cast<std::size_t>(k)] ==
            Approx(silhouette_of(cut(history, k), k, distances)).margin(1e-9));
  }
}

TEST_CASE("every method counts groups that are far apart") {
  for (const Index groups : {2, 3, 5, 8})
    for (const GroupCount method : kMethods)
      for (const Linkage linkage : kLinkages) {
        INFO(name_of(method) << ", " << name_of(linkage) << ", " << groups << " groups");
        CHECK(counted(method, clear_groups(groups, 6), linkage) == groups);
      }
}

TEST_CASE("the number of groups does not depend on the unit of the features") {
  std::vector<float> points = random_points(30, 6, 5, 9);
  std::vector<Index> before;
  for (const GroupCount method : kMethods) before.push_back(counted(method, distances_of(points, 6)));
  for (float& value : points) value *= 1024;
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(counted(kMethods[i], distances_of(points, 6)) == before[i]);
}

TEST_CASE("one item, two items and equal items have a number of groups") {
  for (const GroupCount method : kMethods)
    for (const Linkage linkage : kLinkages) {
      INFO(name_of(method) << ", " << name_of(linkage));
      CHECK(counted(method, distances_of({3}, 1), linkage) == 1);
      CHECK(counted(method, distances_of({3, 4}, 1), linkage) == 2);
      CHECK(counted(method, distances_of({3, 3}, 1), linkage) == 1);
      CHECK(counted(method, distances_of({3, 3, 3, 3, 3}, 1), linkage) == 1);
      CHECK(counted(method, distances_of({3, 3, 90, 90, 3}, 1), linkage) == 2);
    }
}

TEST_CASE("an unknown method is refused") {
  CHECK(group_count_named("gap") == GroupCount::gap);
  CHECK_THROWS_WITH(group_count_named("silhouete"), "[group_count] 'silhouete' is unknown, did you mean 'silhouette'?");
}
