#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "semantics/dendrogram.h"

// Late fusion of several views: evidence accumulation of Fred and Jain (Combining multiple clusterings using evidence
// accumulation, IEEE TPAMI 27, 2005).
namespace svnet::semantics {

/// Squared distances of items by how often labellings put them together: (1 - share of the labellings in which both
/// have the same label)^2. `labels` is (labellings, items): one labelling of all items after the other; any integers,
/// which mean nothing across labellings. Throws Error if there is none, or if sizes do not fit.
DistanceMatrix co_association_distances(std::span<const std::int64_t> labels, Index items);

/// The partition into k clusters on which the labellings agree most: agglomerative clustering by these distances.
/// Throws Error as co_association_distances and cut.
std::vector<std::int32_t> co_association(std::span<const std::int64_t> labels, Index items, Index k,
                                         Linkage linkage = Linkage::average);

}  // namespace svnet::semantics
