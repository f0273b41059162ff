#include "sorting/table.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "base/text.h"

namespace svnet::sorting {
namespace {

std::uint32_t count_of(const auto& list) { return static_cast<std::uint32_t>(list.size()); }

}  // namespace

Tables::Tables(const ViewDataset& dataset, Index objects)
    : dataset_(dataset),
      objects_(objects),
      objects_of_category_(dataset.categories.size()),
      poses_of_object_(dataset.objects.size()) {
  const auto categories = static_cast<Index>(dataset.categories.size());
  check(categories >= kFewestCategories, "a table has objects of at least ", kFewestCategories,
        " categories, and there ", categories == 1 ? "is " : "are ", categories,
        categories > 0 ? ": " + joined_with(", ", dataset.categories) : std::string());
  for (std::size_t i = 0; i < dataset.objects.size(); ++i)
    objects_of_category_[static_cast<std::size_t>(dataset.objects[i].category)].push_back(static_cast<std::int32_t>(i));
  for (std::size_t i = 0; i < dataset.poses.size(); ++i)
    poses_of_object_[static_cast<std::size_t>(dataset.poses[i].object)].push_back(static_cast<std::int32_t>(i));
  std::vector<Index> sizes;
  for (std::size_t c = 0; c < objects_of_category_.size(); ++c) {
    sizes.push_back(static_cast<Index>(objects_of_category_[c].size()));
    check(sizes.back() >= kFewestOfCategory, "category '", dataset.categories[c],
          "' has 1 object, and a table at least ", kFewestOfCategory,
          " of each category; leave it out by --categories");
  }
  // Whatever categories are drawn, they have enough objects.
  std::ranges::sort(sizes);
  const auto smallest = [&](Index n) { return std::accumulate(sizes.begin(), sizes.begin() + n, Index{0}); };
  const Index most = std::min(kMostCategories, categories);
  for (Index n = kFewestCategories; n <= most; ++n)
    if (kFewestOfCategory * n <= objects && objects <= smallest(n)) category_counts_.push_back(n);
  check(!category_counts_.empty(), "no table has ", objects, " objects: with ", kFewestCategories, " to ", most,
        " categories, and at least ", kFewestOfCategory, " objects of each, it has ",
        kFewestOfCategory * kFewestCategories, " to ", smallest(most));
}

Table Tables::draw(std::uint64_t seed, Index number) const {
  RandomStream random(seed, Stream::table, static_cast<std::uint64_t>(number));
  const Index count = category_counts_[random.below(count_of(category_counts_))];
  Table table;
  table.categories.resize(objects_of_category_.size());
  std::iota(table.categories.begin(), table.categories.end(), 0);
  draw_without_replacement(random, table.categories.data(), std::ssize(table.categories), count);
  table.categories.resize(static_cast<std::size_t>(count));

  std::vector<std::int32_t> drawn, left;  // objects
  for (const std::int32_t category : table.categories) {
    std::vector<std::int32_t> of_category = objects_of_category_[static_cast<std::size_t>(category)];
    draw_without_replacement(random, of_category.data(), std::ssize(of_category), kFewestOfCategory);
    drawn.insert(drawn.end(), of_category.begin(), of_category.begin() + kFewestOfCategory);
    left.insert(left.end(), of_category.begin() + kFewestOfCategory, of_category.end());
  }
  const Index more = objects_ - std::ssize(drawn);
  draw_without_replacement(random, left.data(), std::ssize(left), more);
  drawn.insert(drawn.end(), left.begin(), left.begin() + more);

  for (const std::int32_t object : drawn) {
    const auto& poses = poses_of_object_[static_cast<std::size_t>(object)];
    table.poses.push_back(poses[random.below(count_of(poses))]);
  }
  draw_without_replacement(random, table.poses.data(), objects_, objects_);
  for (const std::int32_t pose : table.poses) {
    const auto category = static_cast<std::int32_t>(dataset_.poses[static_cast<std::size_t>(pose)].category);
    table.truth.push_back(
        static_cast<std::int32_t>(std::ranges::find(table.categories, category) - table.categories.begin()));
  }
  return table;
}

}  // namespace svnet::sorting
