#pragma once
#include <vector>

#include "base/enum_names.h"
#include "semantics/dendrogram.h"

namespace svnet::semantics {

/// How the number of groups is estimated.
///   height      the parts above a height between the mean distance of two items and the last merge
///   silhouette  the number with the largest mean silhouette (Rousseeuw, J. Comput. Appl. Math. 20, 1987)
///   gap         the cut in the largest gap between successive heights
/// height is the best by far for few items per group (docs/benchmarks.md, "The number of groups"). All of them assume
/// that there are groups: items of one kind are split in two or three.
enum class GroupCount { height, silhouette, gap };
constexpr auto enum_table(GroupCount) {
  return std::to_array<EnumName<GroupCount>>(
      {{GroupCount::height, "height"}, {GroupCount::silhouette, "silhouette"}, {GroupCount::gap, "gap"}});
}
/// Throws Error for an unknown name.
GroupCount group_count_named(const std::string& name);

/// The estimated number of groups: 1 if all items are equal, 2 for two items that differ. Of more items, silhouette and
/// gap give 2 to n - 1, and the smallest number in a tie. `history` must be that of `distances` by `linkage`. Time:
/// n^2, but n^3 / 2 for silhouette.
Index group_count(GroupCount method, Linkage linkage, const Dendrogram& history, const DistanceMatrix& distances);

/// The height above which GroupCount::height takes the two parts of a merge for different groups.
double group_height(Linkage linkage, const Dendrogram& history, const DistanceMatrix& distances);

/// The mean silhouettes of the partitions of a dendrogram, by Euclidean distances: element k is that of k clusters, for
/// k from 2 to n - 1; elements 0 and 1 are -1. As scikit-learn's silhouette_score: an item that is alone has 0.
std::vector<double> mean_silhouettes(const Dendrogram& history, const DistanceMatrix& distances);

}  // namespace svnet::semantics
