#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "base/enum_names.h"
#include "semantics/problem_distances.h"

namespace svnet {

enum class Linkage { ward, average, complete, single };

template <>
inline constexpr auto enum_names<Linkage> = std::to_array<EnumName<Linkage>>({{Linkage::ward, "ward"},
                                                                              {Linkage::average, "average"},
                                                                              {Linkage::complete, "complete"},
                                                                              {Linkage::single, "single"}});
/// Throws Error for an unknown name.
Linkage linkage_named(const std::string& name);

/// Agglomerative clustering from distances, and the memory it needs. The pair of clusters with the smallest
/// dissimilarity is merged until k are left: Ward, complete and single on squared distances (the partitions are those
/// of the distances), average on distances. All in float32.
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

  /// The same of points whose distances are already together.
  void cluster(const LowerTriangle& distances, Index k, std::span<std::int32_t> labels);

 private:
  void check_sizes(Index points, Index k, Index labels) const;
  void merge_to(Index k, const float* triangle, std::span<std::int32_t> labels);

  Linkage linkage_;
  // A cluster lives in the slot of its first point.
  ProblemDistances dissimilarity_;
  AlignedArray<float> size_, gone_, nearest_value_;
  AlignedArray<std::int32_t> nearest_, merged_into_;
};

}  // namespace svnet
