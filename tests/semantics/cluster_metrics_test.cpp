#include "semantics/cluster_metrics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "semantics/allocations.h"
#include "semantics/clustering_fixtures.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

using Values = std::vector<std::int64_t>;

/// Counts pair by pair, as PAPER.md section 4 defines it.
double brute_force_individual(const Values& truth, const Values& predicted, std::size_t i) {
  double tp = 0, fp = 0, fn = 0;
  for (std::size_t j = 0; j < truth.size(); ++j) {
    if (j == i) continue;
    const bool together = predicted[i] == predicted[j], belong = truth[i] == truth[j];
    tp += together && belong;
    fp += together && !belong;
    fn += !together && belong;
  }
  return tp == 0 ? 0 : tp / std::sqrt((tp + fp) * (tp + fn));
}

Values random_labels(RandomStream& random, Index n, std::uint32_t labels) {
  Values values(n);
  for (auto& value : values) value = static_cast<std::int64_t>(random.below(labels)) * 1000003 - 7;
  return values;
}

}  // namespace

TEST_CASE("metrics are those of scikit-learn") {
  const auto& fixtures = clustering_fixtures().metrics;
  CHECK(fixtures.size() >= 12);
  for (const auto& f : fixtures) {
    const auto near = [](double value) { return Approx(value).epsilon(0).margin(1e-12); };
    INFO(f.truth.size() << " items, Fowlkes-Mallows " << f.fowlkes_mallows);
    CHECK(fowlkes_mallows(f.truth, f.predicted) == near(f.fowlkes_mallows));
    CHECK(normalized_mutual_info(f.truth, f.predicted) == near(f.nmi_arithmetic));
    CHECK(normalized_mutual_info(f.truth, f.predicted, NmiAverage::geometric) == near(f.nmi_geometric));
    CHECK(purity(f.truth, f.predicted) == near(f.purity));
    CHECK(adjusted_rand(f.truth, f.predicted) == near(f.adjusted_rand));
  }
}

TEST_CASE("individual Fowlkes-Mallows counts the pairs of each item") {
  RandomStream random(41, Stream::shuffle);
  for (int repeat = 0; repeat < 60; ++repeat) {
    const Index n = 1 + random.below(40);
    const Values truth = random_labels(random, n, 1 + random.below(9));
    const Values predicted = random_labels(random, n, 1 + random.below(9));
    const auto values = fowlkes_mallows_individual(truth, predicted);
    REQUIRE(static_cast<Index>(values.size()) == n);
    for (Index i = 0; i < n; ++i)
      REQUIRE(values[i] == Approx(brute_force_individual(truth, predicted, i)).epsilon(1e-12));
  }
}

TEST_CASE("only items without a true pair are skipped as singletons") {
  const Values truth{0, 0, 1, 2, 2};
  const Values predicted{5, 6, 6, 7, 7};
  // Item 0 is alone in its cluster, and item 1 is with an item of another class: both miss a partner. Item 2 has none.
  CHECK(fowlkes_mallows_individual(truth, predicted) == std::vector<double>{0, 0, 0, 1, 1});
  const auto skipped = fowlkes_mallows_individual(truth, predicted, Singletons::skip);
  CHECK(std::isnan(skipped[2]));
  for (std::size_t i : {0, 1}) CHECK(skipped[i] == 0);
  for (std::size_t i : {3, 4}) CHECK(skipped[i] == 1);
}

TEST_CASE("0/0 counts as 0: no item has a pair") {
  const Values apart{0, 1, 2, 3}, together{9, 9, 9, 9};
  CHECK(fowlkes_mallows(apart, apart) == 0);
  CHECK(fowlkes_mallows(apart, together) == 0);
  CHECK(fowlkes_mallows(together, apart) == 0);
  CHECK(fowlkes_mallows_individual(apart, apart) == std::vector<double>(4, 0.0));
  CHECK(fowlkes_mallows_individual(together, apart) == std::vector<double>(4, 0.0));
}

TEST_CASE("pairs are counted in 64 bits") {
  const Values together(200000, 3);
  CHECK(fowlkes_mallows(together, together) == 1);
  CHECK(adjusted_rand(together, together) == 1);
  Values halves = together;
  std::fill_n(halves.begin(), 100000, 4);
  const double both = 2 * 100000.0 * 99999, all = 200000.0 * 199999;
  CHECK(fowlkes_mallows(together, halves) == Approx(std::sqrt(both / all)).epsilon(1e-12));
  CHECK(fowlkes_mallows_individual(together, halves)[7] == Approx(std::sqrt(99999 / 199999.0)).epsilon(1e-12));
}

TEST_CASE("metrics of many labels take little time and memory") {
  Values apart(100000);
  std::iota(apart.begin(), apart.end(), -50000);
  CHECK(purity(apart, apart) == 1);
  CHECK(normalized_mutual_info(apart, apart) == Approx(1).epsilon(1e-12));
}

TEST_CASE("counting and scoring allocate nothing, and a contingency can be reused") {
  RandomStream random(42, Stream::shuffle);
  Contingency contingency(50);
  std::vector<double> values(50);
  std::vector<std::int32_t> truth(50), predicted(50);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const std::size_t n = 1 + random.below(50);
    for (auto& label : truth) label = static_cast<std::int32_t>(random.below(50));
    for (auto& label : predicted) label = static_cast<std::int32_t>(random.below(7));
    const std::span t(truth.data(), n), p(predicted.data(), n);
    const std::size_t before = allocations();
    contingency.count(t, p);
    contingency.fowlkes_mallows_individual(Singletons::zero, std::span(values.data(), n));
    const double fm = contingency.fowlkes_mallows(), share = contingency.purity(), rand = contingency.adjusted_rand();
    CHECK(allocations() == before);
    const Values t64(t.begin(), t.end()), p64(p.begin(), p.end());
    CHECK(fm == fowlkes_mallows(t64, p64));
    CHECK(share == purity(t64, p64));
    CHECK(rand == adjusted_rand(t64, p64));
    for (std::size_t i = 0; i < n; ++i)
      REQUIRE(values[i] == Approx(brute_force_individual(t64, p64, i)).epsilon(1e-12));
  }
}

TEST_CASE("normalized mutual information is never above 1") {
  CHECK(normalized_mutual_info(Values{0, 0, 0, 1, 1}, Values{0, 0, 0, 1, 1}) == 1);
  CHECK(normalized_mutual_info(Values{0, 0, 0, 1, 1}, Values{7, 7, 7, 2, 2}, NmiAverage::geometric) <= 1);
}

TEST_CASE("metrics refuse labels that do not match") {
  CHECK_THROWS_WITH(fowlkes_mallows(Values{1, 2}, Values{1}), "[cluster metrics] 2 true labels for 1 predicted ones");
  CHECK_THROWS_WITH(purity(Values{}, Values{}), "[cluster metrics] there are no labels; one item at least is needed");
  Contingency contingency(3);
  const std::vector<std::int32_t> good{0, 1, 2}, low{0, -1, 2}, high{0, 1, 3};
  CHECK_THROWS_WITH(contingency.count(low, good), "[cluster metrics] labels from -1 to 2 where 0 to 2 are allowed");
  CHECK_THROWS_WITH(contingency.count(good, high), "[cluster metrics] labels from 0 to 3 where 0 to 2 are allowed");
  contingency.count(good, good);
  std::vector<double> values(2);
  CHECK_THROWS_WITH(contingency.fowlkes_mallows_individual(Singletons::zero, values),
                    "[cluster metrics] 2 values for 3 items");
}
