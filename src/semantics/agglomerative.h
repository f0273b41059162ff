#pragma once
#include <cstdint>
#include <span>

#include "semantics/linkage.h"
#include "semantics/problem_distances.h"

namespace svnet::semantics {

/// Agglomerative clustering in float32, with its memory. Merges the pair of clusters with the smallest dissimilarity
/// until k are left. Ward, complete and single linkage work on squared distances, average on distances; complete and
/// single linkage give the same partitions for both.
///
/// Ties: clusters are ordered by their first points. Among equal pairs, the one whose earlier cluster comes first is
/// merged; then the one whose later cluster comes first. Not thread-safe: use one object per thread.
class Agglomerative {
 public:
  Agglomerative(Linkage linkage, Index max_points);

  /// Sets labels[i] to the cluster of rows[i]; clusters are numbered from 0 in order of first appearance. Allocates
  /// nothing. Throws Error if k is not in [1, rows.size()] or there are more rows than max_points.
  void cluster(const DistanceMatrix& distances, std::span<const std::int32_t> rows, Index k,
               std::span<std::int32_t> labels);

  /// The same for the points of `distances`.
  void cluster(const LowerTriangle& distances, Index k, std::span<std::int32_t> labels);

 private:
  void check_sizes(Index points, Index k, Index labels) const;
  void merge_to(Index k, const float* triangle, std::span<std::int32_t> labels);

  Linkage linkage_;
  // A cluster is in the slot of its first point.
  ProblemDistances dissimilarity_;
  Index room_;  // elements of an array
  AlignedArray<float> size_, gone_, scratch_, nearest_value_, next_value_;
  AlignedArray<float> sides_;  // (3, room) infinity, 0, infinity: only_later and only_earlier
  AlignedArray<std::int32_t> nearest_, merged_into_;
};

}  // namespace svnet::semantics
