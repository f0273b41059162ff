#pragma once
#include <cstdint>
#include <vector>

#include "data/view_dataset.h"

namespace svnet::sorting {

/// Objects on a table, in random order.
struct Table {
  std::vector<std::int32_t> categories;  ///< of the dataset, in draw order
  std::vector<std::int32_t> poses;       ///< (objects) of the dataset
  std::vector<std::int32_t> truth;       ///< (objects) the category, as an index into `categories`
};

/// Limits of a table.
inline constexpr Index kFewestCategories = 3, kMostCategories = 5, kFewestOfCategory = 2;

/// Random tables of `objects` objects each. A table is drawn in this order: the number of categories, 3 to 5, or up to
/// as many as there are; the categories; two objects of each; the other objects, among all that these categories have
/// left; a pose of each object; the order of the objects. Every draw is uniform, and no object is drawn twice.
/// Immutable, so any number of threads may draw.
class Tables {
 public:
  /// Keeps a reference to the dataset. Throws Error if it has fewer than 3 categories, a category has fewer than 2
  /// objects, or no table has so many objects.
  Tables(const ViewDataset& dataset, Index objects);

  /// Table `number` (from 0), of Stream::table.
  Table draw(std::uint64_t seed, Index number) const;

 private:
  const ViewDataset& dataset_;
  Index objects_;
  std::vector<std::vector<std::int32_t>> objects_of_category_;
  std::vector<std::vector<std::int32_t>> poses_of_object_;
  std::vector<Index> category_counts_;  // that a table may have
};

}  // namespace svnet::sorting
