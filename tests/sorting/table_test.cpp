#include "sorting/table.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "base/error.h"
#include "made_up_dataset.h"

using namespace svnet;
using sorting::Table;
using sorting::Tables;

TEST_CASE("a table has different objects of 3 to 5 categories, and several of each") {
  const ViewDataset dataset = made_up_dataset({4, 5, 6, 4, 5, 4, 4}, 2);
  const Tables tables(dataset, 12);
  std::map<std::size_t, int> counts;
  std::set<std::int32_t> categories, poses;
  for (Index number = 0; number < 300; ++number) {
    const Table table = tables.draw(7, number);
    ++counts[table.categories.size()];
    CHECK(std::set(table.categories.begin(), table.categories.end()).size() == table.categories.size());
    REQUIRE(table.poses.size() == 12);
    REQUIRE(table.truth.size() == 12);
    std::set<Index> objects;
    std::map<std::int32_t, int> of_category;
    for (std::size_t i = 0; i < table.poses.size(); ++i) {
      const auto& pose = dataset.poses[static_cast<std::size_t>(table.poses[i])];
      objects.insert(pose.object);
      ++of_category[table.truth[i]];
      CHECK(table.categories[static_cast<std::size_t>(table.truth[i])] == pose.category);
    }
    CHECK(objects.size() == 12);
    CHECK(of_category.size() == table.categories.size());
    for (const auto& [category, count] : of_category) CHECK(count >= 2);
    categories.insert(table.categories.begin(), table.categories.end());
    poses.insert(table.poses.begin(), table.poses.end());
  }
  CHECK(counts.size() == 3);
  for (const std::size_t count : {3u, 4u, 5u}) CHECK(counts[count] > 60);
  CHECK(categories.size() == 7);
  CHECK(poses.size() == dataset.poses.size());
}

TEST_CASE("seed and number determine a table") {
  const ViewDataset dataset = made_up_dataset({5, 5, 5, 5}, 3);
  const Tables tables(dataset, 12);
  const Table first = tables.draw(1, 0), again = Tables(dataset, 12).draw(1, 0);
  CHECK(first.poses == again.poses);
  CHECK(first.truth == again.truth);
  CHECK(first.poses != tables.draw(1, 1).poses);
  CHECK(first.poses != tables.draw(2, 0).poses);
}

TEST_CASE("only numbers of categories are drawn that have enough objects") {
  const ViewDataset dataset = made_up_dataset({3, 3, 3, 3});
  for (Index number = 0; number < 50; ++number) {
    CHECK(Tables(dataset, 6).draw(0, number).categories.size() == 3);
    CHECK(Tables(dataset, 12).draw(0, number).categories.size() == 4);
  }
}

TEST_CASE("tables that cannot be drawn are refused") {
  CHECK_THROWS_WITH(Tables(made_up_dataset({3, 3}), 6),
                    "a table has objects of at least 3 categories, and there are 2: a, b");
  CHECK_THROWS_WITH(Tables(made_up_dataset({3, 1, 3}), 6),
                    "category 'b' has 1 object, and a table at least 2 of each category; leave it out by --categories");
  for (const Index objects : {5, 10})
    CHECK_THROWS_WITH(Tables(made_up_dataset({3, 3, 3}), objects),
                      joined("no table has ", objects,
                             " objects: with 3 to 3 categories, and at least 2 objects of each, it has 6 to 9"));
}

TEST_CASE("a dataset of some categories has their objects, poses and views") {
  const ViewDataset all = made_up_dataset({2, 3, 1, 2}, 2), part = with_categories(all, {false, true, false, true});
  CHECK(part.categories == std::vector<std::string>{"b", "d"});
  REQUIRE(part.objects.size() == 5);
  CHECK(part.objects[3].category == 1);
  REQUIRE(part.poses.size() == 10);
  REQUIRE(part.views.size() == 30);
  for (std::size_t p = 0; p < part.poses.size(); ++p) {
    const auto& pose = part.poses[p];
    CHECK(pose.first_view == 3 * static_cast<Index>(p));
    CHECK(part.views[static_cast<std::size_t>(pose.top_view)].top);
    for (const View& view : part.views_of(static_cast<Index>(p))) {
      CHECK(view.pose == static_cast<Index>(p));
      CHECK(view.object == pose.object);
      CHECK(view.category == pose.category);
    }
  }
  CHECK(part.pose_path(6) == "d/1/1");
  CHECK(with_categories(all, std::vector<bool>(4, true)).views.size() == all.views.size());
}
