#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/enum_names.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"

namespace svnet::semantics {

/// How the features of several views of an object become those of one item.
///   mean         their mean
///   concatenate  one after the other, in the order of the set
enum class Fusion { mean, concatenate };
constexpr auto enum_table(Fusion) {
  return std::to_array<EnumName<Fusion>>({{Fusion::mean, "mean"}, {Fusion::concatenate, "concatenate"}});
}

/// Sets of `size` views each: (sets, size) rows of a distance matrix.
struct ViewSets {
  Index size = 1;
  std::vector<std::int32_t> views{};
  Fusion fusion = Fusion::mean;

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
  /// Keeps a reference to the distances. Memory for up to max_items items of `size` views.
  SetDistances(const DistanceMatrix& distances, Index size, Fusion fusion, Index max_items);

  /// views: (items, size) rows of the matrix. The result is valid until the next call. Allocates nothing.
  LowerTriangle of(std::span<const std::int32_t> views);

 private:
  void add_row(std::span<const std::int32_t> views, Index item, Index member, float* to) const;
  float spread(std::span<const std::int32_t> set) const;

  const DistanceMatrix& distances_;
  Index size_;
  Fusion fusion_;
  std::vector<float> spread_;  // of each item: 1/k² Σ d(a, a') over its pairs
  AlignedArray<float> triangle_;
};

/// The squared distances between the sets {v, partner[v]} of all views: with them, scores of views are scores of sets.
/// Throws Error if there is not one partner per view.
DistanceMatrix distances_with_partner(const DistanceMatrix& distances, std::span<const std::int32_t> partner,
                                      Fusion fusion, Parallel& parallel);

}  // namespace svnet::semantics
