#include "sorting/simulation.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "made_up_dataset.h"
#include "semantics/group_count.h"

using namespace svnet;
using namespace svnet::sorting;

namespace {

std::vector<std::int32_t> side_views(const ViewDataset& dataset) {
  std::vector<std::int32_t> views;
  for (const auto& pose : dataset.poses) views.push_back(static_cast<std::int32_t>(pose.first_view) + 1);
  return views;
}

std::vector<train::Selector> some_selectors(const ViewDataset& dataset) {
  std::vector<std::int32_t> both;
  for (const std::int32_t view : side_views(dataset)) both.insert(both.end(), {view, view + 1});
  return {{"top", train::top_views(dataset)}, {"rand", {}}, {"side", side_views(dataset)}, {"side_2", both, 2}};
}

}  // namespace

TEST_CASE("tables are sorted by what the chosen views show") {
  const ViewDataset dataset = made_up_dataset({5, 5, 5, 5}, 2);
  const std::vector<float> features = telling_from_the_side(dataset);
  Parallel parallel(1);
  const auto selectors = some_selectors(dataset);
  const auto tables = simulate(dataset, features, selectors, {.tables = 40}, {}, parallel);
  REQUIRE(tables.size() == 40);
  Index wrong_top = 0, views_differ = 0;
  for (const SortedTable& table : tables) {
    REQUIRE(table.outcomes.size() == 4);
    for (const Outcome& outcome : table.outcomes) {
      CHECK(outcome.wrong_count == std::ranges::count(outcome.wrong, true));
      CHECK(static_cast<std::size_t>(std::ranges::max(outcome.bins)) + 1 == table.table.categories.size());
    }
    wrong_top += table.outcomes[0].wrong_count;
    CHECK(table.outcomes[0].camera.moves == 0);
    CHECK(table.outcomes[2].wrong_count == 0);
    CHECK(table.outcomes[2].camera.moves == 12);
    CHECK(table.outcomes[2].camera.seconds == Approx(12 * (1.5 + 45.0 / 60)));
    CHECK(table.outcomes[3].wrong_count == 0);
    CHECK(table.outcomes[3].camera.moves == 24);
    CHECK(table.outcomes[3].views.size() == 24);
    for (std::size_t i = 0; i < 12; ++i) {
      const std::int32_t view = table.outcomes[1].views[i];
      CHECK(dataset.views[static_cast<std::size_t>(view)].pose == table.table.poses[i]);
      views_differ += view != table.outcomes[0].views[i];
    }
  }
  CHECK(wrong_top > 40);
  CHECK(views_differ > 480 / 2);
  CHECK(views_differ < 480);
}

TEST_CASE("a simulation has the same bits for any number of threads") {
  const ViewDataset dataset = made_up_dataset({5, 4, 5, 6}, 2);
  const std::vector<float> features = telling_from_the_side(dataset);
  const auto selectors = some_selectors(dataset);
  const SimulationOptions options{.tables = 70, .objects = 9, .seed = 3};
  Parallel one(1), three(3);
  const auto expected = simulate(dataset, features, selectors, options, {}, one);
  const auto tables = simulate(dataset, features, selectors, options, {}, three);
  for (std::size_t t = 0; t < expected.size(); ++t)
    for (std::size_t s = 0; s < selectors.size(); ++s) {
      CHECK(tables[t].outcomes[s].views == expected[t].outcomes[s].views);
      CHECK(tables[t].outcomes[s].bins == expected[t].outcomes[s].bins);
      CHECK(tables[t].outcomes[s].camera.seconds == expected[t].outcomes[s].camera.seconds);
    }
}

TEST_CASE("the number of groups is given or estimated") {
  const ViewDataset dataset = made_up_dataset({5, 5, 5, 5});
  const std::vector<float> features = telling_from_the_side(dataset);
  const std::vector<train::Selector> selectors{{"side", side_views(dataset)}};
  Parallel parallel(1);
  const auto sorted = [&](GroupRule rule) {
    return simulate(dataset, features, selectors, {.tables = 10, .groups = rule}, {}, parallel);
  };
  const auto groups = [](const SortedTable& table) { return std::ranges::max(table.outcomes[0].bins) + 1; };
  for (const SortedTable& table : sorted({GroupRule::Kind::fixed, 7})) CHECK(groups(table) == 7);
  for (const SortedTable& table : sorted({GroupRule::Kind::estimated, 0})) {
    std::vector<float> seen;
    for (const std::int32_t view : table.outcomes[0].views)
      seen.insert(seen.end(), features.begin() + 2 * view, features.begin() + 2 * view + 2);
    const auto distances = semantics::squared_distances(seen.data(), 12, 2, parallel);
    CHECK(groups(table) == semantics::group_count(semantics::GroupCount::height, semantics::Linkage::ward,
                                                  semantics::dendrogram(semantics::Linkage::ward, distances),
                                                  distances));
  }
  CHECK_THROWS_WITH(sorted({GroupRule::Kind::fixed, 13}), "cannot make 13 groups of 12 objects");
}
