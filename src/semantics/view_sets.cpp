#include "semantics/view_sets.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::semantics {

SetDistances::SetDistances(const DistanceMatrix& distances, Index size, Fusion fusion, Index max_items)
    : distances_(distances),
      size_(size),
      fusion_(fusion),
      spread_(static_cast<std::size_t>(max_items)),
      triangle_(LowerTriangle::size(max_items)) {}

float SetDistances::spread(std::span<const std::int32_t> set) const {
  float sum = 0;
  for (std::size_t i = 1; i < set.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) sum += distances_(set[i], set[j]);
  return sum / static_cast<float>(size_ * size_);
}

/// Adds the distances of one view of an item to those of the items before it.
void SetDistances::add_row(std::span<const std::int32_t> views, Index item, Index member, float* to) const {
  const float* const row = distances_.row(views[static_cast<std::size_t>(item * size_ + member)]);
  const std::int32_t* other = views.data();
  if (fusion_ == Fusion::concatenate) {
    for (Index j = 0; j < item; ++j, other += size_) to[j] += row[other[member]];
    return;
  }
  for (Index j = 0; j < item; ++j, other += size_)
    for (Index i = 0; i < size_; ++i) to[j] += row[other[i]];
}

LowerTriangle SetDistances::of(std::span<const std::int32_t> views) {
  const Index items = static_cast<Index>(views.size()) / size_;
  const bool means = fusion_ == Fusion::mean;
  for (Index i = 0; i < items; ++i)
    spread_[static_cast<std::size_t>(i)] =
        means ? spread(views.subspan(static_cast<std::size_t>(i * size_), static_cast<std::size_t>(size_))) : 0.0f;
  const float share = means ? 1.0f / static_cast<float>(size_ * size_) : 1.0f;
  for (Index i = 1; i < items; ++i) {
    float* const row = triangle_.data() + LowerTriangle::row_offset(i);
    std::fill_n(row, i, 0.0f);
    for (Index member = 0; member < size_; ++member) add_row(views, i, member, row);
    for (Index j = 0; j < i; ++j)  // rounding must not make it negative
      row[j] =
          std::max(row[j] * share - spread_[static_cast<std::size_t>(i)] - spread_[static_cast<std::size_t>(j)], 0.0f);
  }
  return {triangle_.data(), items};
}

DistanceMatrix distances_with_partner(const DistanceMatrix& distances, std::span<const std::int32_t> partner,
                                      Fusion fusion, Parallel& parallel) {
  const Index n = distances.size();
  check(static_cast<Index>(partner.size()) == n, "[sets] ", partner.size(), " partners for ", n, " views");
  DistanceMatrix result(n);
  parallel.for_chunks(n, 16, [&](Index first, Index last, int) {
    for (Index v = first; v < last; ++v) {
      const auto own = partner[static_cast<std::size_t>(v)];
      const float *const of_view = distances.row(v), *const of_partner = distances.row(own);
      float* const to = result.row(v);
      for (Index w = 0; w < n; ++w) {
        const auto other = partner[static_cast<std::size_t>(w)];
        to[w] = fusion == Fusion::concatenate
                    ? of_view[w] + of_partner[other]
                    : std::max(((of_view[w] + of_partner[other]) + (of_view[other] + of_partner[w])) / 4 -
                                   of_view[own] / 4 - distances(w, other) / 4,
                               0.0f);
      }
      to[v] = 0;
    }
  });
  return result;
}

}  // namespace svnet::semantics
