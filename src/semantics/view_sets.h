#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "semantics/distances.h"
#include "semantics/lower_triangle.h"
#include "semantics/view_fusion.h"

namespace svnet::semantics {

/// Sets of `size` views each: (sets, size) rows of a distance matrix.
struct ViewSets {
  Index size = 1;
  std::vector<std::int32_t> views{};
  ViewFusion fusion = ViewFusion::mean;

  Index count() const { return static_cast<Index>(views.size()) / size; }
  std::span<const std::int32_t> set(Index i) const {
    return std::span(views).subspan(static_cast<std::size_t>(i * size), static_cast<std::size_t>(size));
  }
};

/// The squared distances between the fused features of items, from those between views alone. For means of k views
///   D(A, B) = 1/k² Σ d(a, b) − 1/k² Σ d(a, a') − 1/k² Σ d(b, b')
/// with the last two sums over pairs; for concatenated features Σ d(a_i, b_i). Not thread-safe: one object per thread.
class SetDistances {
 public:
  /// Memory for up to max_items items of `size` views.
  SetDistances(Index size, ViewFusion fusion, Index max_items);

  /// views: the distances between all views of the items, set by set. The result is valid until the next call.
  /// Allocates nothing.
  LowerTriangle of(const LowerTriangle& views);
  /// views: (items, size) rows of the matrix.
  LowerTriangle of(const DistanceMatrix& distances, std::span<const std::int32_t> views);

 private:
  float spread(const LowerTriangle& views, Index item) const;

  Index size_;
  ViewFusion fusion_;
  std::vector<float> spread_;  // of each item: 1/k² Σ d(a, a') over its pairs
  AlignedArray<float> of_views_, triangle_;
};

/// The squared distances between the sets {v, partner[v]} of all views: with them, scores of views are scores of sets.
/// Throws Error if there is not one partner per view.
DistanceMatrix distances_with_partner(const DistanceMatrix& distances, std::span<const std::int32_t> partner,
                                      ViewFusion fusion, Parallel& parallel);

}  // namespace svnet::semantics
