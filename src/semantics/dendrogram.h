#pragma once
#include <cstdint>
#include <vector>

#include "semantics/distances.h"
#include "semantics/linkage.h"

namespace svnet::semantics {

/// One step of agglomerative clustering. Cluster i < items is item i; cluster items + m is the result of merge m.
struct Merge {
  std::int32_t a, b;  ///< the merged clusters, a < b
  double height;      ///< their dissimilarity as SciPy's linkage has it: a distance, not squared
  Index size;         ///< items in the result
};

/// The history of an agglomerative clustering, down to one cluster.
struct Dendrogram {
  Index items;
  std::vector<Merge> merges;  ///< items - 1, in order; heights never decrease
};

/// The dendrogram of all points. Decides as Agglomerative does, bit by bit and in ties too, so a cut gives its
/// partitions. Without ties it is SciPy's linkage(features, method); heights are computed in float32.
/// Memory: 4 n^2 bytes. Time: about n^2, at worst n^3. Throws Error for no points.
Dendrogram dendrogram(Linkage linkage, const DistanceMatrix& distances);

/// The partition into k clusters: labels of the items, numbered from 0 in order of first appearance. Throws Error if k
/// is not in [1, items].
std::vector<std::int32_t> cut(const Dendrogram& dendrogram, Index k);

}  // namespace svnet::semantics
