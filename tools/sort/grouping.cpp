#include "sort/grouping.h"

#include "base/error.h"
#include "base/parallel.h"
#include "semantics/group_count.h"

namespace svnet {
using semantics::Linkage;

namespace {

double height_between(const semantics::Dendrogram& history, Index groups) {
  const auto& merges = history.merges;
  if (merges.empty()) return 0;
  if (groups == 1) return 1.05 * merges.back().height;
  const auto above = static_cast<std::size_t>(history.items - groups);
  return (merges[above].height + (above == 0 ? 0 : merges[above - 1].height)) / 2;
}

}  // namespace

void check_groups(std::optional<Index> groups, Index objects) {
  check(!groups || *groups <= objects, "cannot make ", groups.value_or(0), " groups of ", objects,
        objects == 1 ? " object" : " objects", "; give --groups 1 to ", objects, ", or auto");
}

Grouping grouped(std::span<const float> features, Index objects, Linkage linkage, std::optional<Index> groups) {
  check_groups(groups, objects);
  const auto distances = semantics::squared_distances(
      features.data(), objects, static_cast<Index>(features.size()) / objects, Parallel::shared());
  Grouping result{semantics::dendrogram(linkage, distances), {}, 0, 0};
  result.groups =
      groups ? *groups : semantics::group_count(semantics::GroupCount::height, linkage, result.history, distances);
  result.group = semantics::cut(result.history, result.groups);
  result.cut_height = height_between(result.history, result.groups);
  return result;
}

std::vector<std::vector<std::size_t>> members_of(const Grouping& grouping) {
  std::vector<std::vector<std::size_t>> members(static_cast<std::size_t>(grouping.groups));
  for (std::size_t i = 0; i < grouping.group.size(); ++i)
    members[static_cast<std::size_t>(grouping.group[i])].push_back(i);
  return members;
}

}  // namespace svnet
