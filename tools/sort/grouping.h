#pragma once
#include <optional>
#include <span>
#include <vector>

#include "semantics/dendrogram.h"

namespace svnet {

/// Objects in groups, numbered from 0 in order of first appearance.
struct Grouping {
  semantics::Dendrogram history;
  std::vector<std::int32_t> group;  ///< of each object
  Index groups;
  double cut_height;  ///< in the middle between the highest merge that was made and the lowest one that was not
};

/// Throws Error if so many objects cannot be put into that number of groups; empty: it is estimated.
void check_groups(std::optional<Index> groups, Index objects);

/// Groups the rows of features (objects, D). `groups`: their number; empty: it is estimated. Throws Error if it is not
/// in [1, objects].
Grouping grouped(std::span<const float> features, Index objects, semantics::Linkage linkage,
                 std::optional<Index> groups);

/// The members of each group, in order.
std::vector<std::vector<std::size_t>> members_of(const Grouping& grouping);

}  // namespace svnet
