#include "semantics/view_sets.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::semantics {

SetDistances::SetDistances(Index size, ViewFusion fusion, Index max_items)
    : size_(size),
      fusion_(fusion),
      spread_(static_cast<std::size_t>(max_items)),
      of_views_(LowerTriangle::size(max_items * size)),
      triangle_(LowerTriangle::size(max_items)) {}

float SetDistances::spread(const LowerTriangle& views, Index item) const {
  float sum = 0;
  for (Index i = 1; i < size_; ++i)
    for (Index j = 0; j < i; ++j) sum += views.row(item * size_ + i)[item * size_ + j];
  return sum / static_cast<float>(size_ * size_);
}

LowerTriangle SetDistances::of(const LowerTriangle& views) {
  const Index items = views.points / size_;
  const bool means = fusion_ == ViewFusion::mean;
  for (Index i = 0; i < items; ++i) spread_[static_cast<std::size_t>(i)] = means ? spread(views, i) : 0.0f;
  const float share = means ? 1.0f / static_cast<float>(size_ * size_) : 1.0f;
  for (Index i = 1; i < items; ++i) {
    float* const row = triangle_.data() + LowerTriangle::row_offset(i);
    std::fill_n(row, i, 0.0f);
    for (Index member = 0; member < size_; ++member) {
      const float* from = views.row(i * size_ + member);
      if (means)
        for (Index j = 0; j < i; ++j, from += size_)
          for (Index other = 0; other < size_; ++other) row[j] += from[other];
      else
        for (Index j = 0; j < i; ++j, from += size_) row[j] += from[member];
    }
    for (Index j = 0; j < i; ++j)  // rounding must not make it negative
      row[j] =
          std::max(row[j] * share - spread_[static_cast<std::size_t>(i)] - spread_[static_cast<std::size_t>(j)], 0.0f);
  }
  return {triangle_.data(), items};
}

LowerTriangle SetDistances::of(const DistanceMatrix& distances, std::span<const std::int32_t> views) {
  for (std::size_t i = 1; i < views.size(); ++i) {
    const float* const from = distances.row(views[i]);
    float* const to = of_views_.data() + LowerTriangle::row_offset(static_cast<Index>(i));
    for (std::size_t j = 0; j < i; ++j) to[j] = from[views[j]];
  }
  return of({of_views_.data(), static_cast<Index>(views.size())});
}

DistanceMatrix distances_with_partner(const DistanceMatrix& distances, std::span<const std::int32_t> partner,
                                      ViewFusion fusion, Parallel& parallel) {
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
        to[w] = fusion == ViewFusion::concatenate
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
