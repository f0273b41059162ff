#include "semantics/co_association.h"

#include "base/error.h"

namespace svnet::semantics {

DistanceMatrix co_association_distances(std::span<const std::int64_t> labels, Index items) {
  const auto count = static_cast<Index>(labels.size());
  check(items >= 1 && count >= items, "[co_association] labels are ", items > 0 ? count / items : 0, "x", items,
        "; at least one labelling of one item is needed");
  check(count % items == 0, "[co_association] ", count, " labels are no whole number of labellings of ", items,
        " items");
  const Index labellings = count / items;
  DistanceMatrix distances(items);
  for (Index i = 0; i < items; ++i)
    for (Index j = 0; j < i; ++j) {
      Index apart = 0;
      for (Index l = 0; l < labellings; ++l) {
        const std::int64_t* labelling = labels.data() + l * items;
        apart += labelling[i] != labelling[j];
      }
      const double share = static_cast<double>(apart) / static_cast<double>(labellings);
      distances.row(i)[j] = distances.row(j)[i] = static_cast<float>(share * share);
    }
  return distances;
}

std::vector<std::int32_t> co_association(std::span<const std::int64_t> labels, Index items, Index k, Linkage linkage) {
  return cut(dendrogram(linkage, co_association_distances(labels, items)), k);
}

}  // namespace svnet::semantics
