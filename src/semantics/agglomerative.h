#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "semantics/distances.h"

namespace svnet {

enum class Linkage { ward, average, complete, single };

std::string_view linkage_name(Linkage linkage);
/// Throws Error for an unknown name.
Linkage linkage_named(std::string_view name);

/// Agglomerative clustering of some rows of a distance matrix, and the memory it needs. The pair of clusters with the
/// smallest dissimilarity is merged until k are left: Ward, complete and single on squared distances (the partitions
/// are those of the distances), average on distances.
///
/// Ties: a cluster is known by its first point; among equal pairs the one whose lower cluster comes first is merged,
/// and among those the one whose other cluster comes first. Not thread-safe: one object per thread.
class Agglomerative {
 public:
  Agglomerative(Linkage linkage, Index max_points);

  /// labels[i] is the cluster of rows[i], numbered from 0 in order of first appearance. Allocates nothing.
  /// Throws Error for k outside [1, rows.size()] and for more rows than max_points.
  void cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
               std::span<std::int32_t> labels);

 private:
  void gather(const DistanceMatrix& distances, std::span<const std::int32_t> rows);
  void find_nearest(Index i);
  void merge(Index a, Index b);
  void update_nearest(Index a, Index b);

  Linkage linkage_;
  Index max_points_;
  Index n_ = 0, stride_ = 0;
  // A cluster lives in the slot of its first point. Slots that were merged away are infinitely far from all others, so
  // that no loop needs to ask whether a slot is alive.
  std::vector<double> dissimilarity_;          // (n, stride), symmetric, infinite diagonal
  std::vector<double> size_;                   // (n)
  std::vector<double> nearest_dissimilarity_;  // (n) to the nearest of the later slots
  std::vector<std::int32_t> nearest_;          // (n) that slot; -1: none
  std::vector<std::int32_t> merged_into_;      // (n) an earlier slot, or the slot itself
};

}  // namespace svnet
