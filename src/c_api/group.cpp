// Groups of like objects, for callers that have features.
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "guard.h"
#include "semantics/group_count.h"

svnet_status svnet_group(const float* features, size_t rows, size_t columns, size_t groups, int32_t* labels,
                         size_t* count) {
  using namespace svnet;
  using namespace svnet::semantics;
  return computed(SVNET_INVALID_ARGUMENT, [&] {
    constexpr std::size_t kMostRows = 65535, kMostColumns = 1 << 24;
    check_given(features, "svnet_group", "features");
    check_given(labels, "svnet_group", "labels");
    check(rows >= 1 && rows <= kMostRows, "[svnet_group] rows is ", rows, ", expected 1 to ", kMostRows);
    check(columns >= 1 && columns <= kMostColumns, "[svnet_group] columns is ", columns, ", expected 1 to ",
          kMostColumns);
    check(groups <= rows, "[svnet_group] cannot make ", groups, " groups of ", rows, " rows");
    constexpr Linkage kLinkage = Linkage::ward;
    const DistanceMatrix distances =
        squared_distances(features, static_cast<Index>(rows), static_cast<Index>(columns), Parallel::shared());
    const Dendrogram history = dendrogram(kLinkage, distances);
    const Index made =
        groups > 0 ? static_cast<Index>(groups) : group_count(GroupCount::height, kLinkage, history, distances);
    const std::vector<std::int32_t> found = cut(history, made);
    std::ranges::copy(found, labels);
    if (count != nullptr) *count = static_cast<std::size_t>(made);
  });
}
