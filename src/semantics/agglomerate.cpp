// Greedy agglomeration with cached nearest neighbours, after Müllner, "Modern hierarchical, agglomerative clustering
// algorithms" (arXiv 1109.2378), section 3; updates by Lance and Williams (The Computer Journal 9, 1967).
//
// The linkages are reducible: a merged cluster is never nearer to a third cluster than the nearer of its two parts was.
// So the distance of a slot to its nearest later slot, once computed, stays a lower bound, and so does that to its
// second nearest one. If the nearest slot is merged, the smaller of the second bound and the dissimilarity to the
// merged cluster is the new bound. If it is the latter, the nearest slot is known again. Otherwise the slot is searched
// again, but only once its bound is the smallest.
//
// A merge changes a row and a column. Stores of single floats delay the next loads of whole vectors of the same rows,
// so a column waits in its row until the next merge has loaded its two rows. Meanwhile it is `pending`.
#include "semantics/agglomerate.h"

#include <array>
#include <cstdint>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semantics/agglomerate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "semantics/agglomerate_rows-inl.h"
#include "semantics/agglomerate_start-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::semantics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether the update of the dissimilarities needs the sizes of the clusters.
constexpr bool uses_sizes(Linkage linkage) {
  switch (linkage) {
    case Linkage::ward:
    case Linkage::average:
      return true;
    case Linkage::complete:
    case Linkage::single:
      return false;
  }
  return true;
}

/// Whether a column waits until the next merge. That gains only if the rows of a merge fit in registers, of which there
/// are 32 with AVX-512.
template <int kVectors>
constexpr bool kDefers = kVectors > 0 && hn::MaxLanes(Floats()) == 16;

/// A slot with the smallest bound, and its nearest later slot; kUnknown: it must be searched.
struct Candidate {
  Index slot, nearest;
};

/// Sets the bounds of slot a, of which `later` has the dissimilarities to later slots, infinity elsewhere. `bounds` are
/// those of the other slots. Returns the candidate with the smallest bound of all slots.
template <int kVectors>
HWY_INLINE Candidate conclude(const AgglomerationState& s, Index a, const Row<kVectors>& later,
                              const Row<kVectors>& bounds) {
  const Floats d;
  const Index count = vectors<kVectors>(s.n);
  auto nearest = later.get(0), other = bounds.get(0);
  for (Index v = 1; v < count; ++v) {
    nearest = hn::Min(nearest, later.get(v));
    other = hn::Min(other, bounds.get(v));
  }
  other = hn::MinOfLanes(d, other);
  nearest = hn::MinOfLanes(d, nearest);
  auto next = hn::Set(d, kLargest);
  for (Index v = 0; v < count; ++v) {
    const auto value = later.get(v);
    next = hn::Min(next, hn::IfThenElse(hn::Eq(value, nearest), next, value));
  }
  next = hn::MinOfLanes(d, next);
  bool is_only = false;
  const Index of_nearest = first_equal<kVectors>(s.n, later, nearest, &is_only);
  const Index slot = first_equal<kVectors>(s.n, bounds, other, nullptr);
  set(s.nearest_value, a, nearest);
  set(s.next_value, a, HWY_LIKELY(is_only) ? next : hn::Min(nearest, hn::Set(d, kLargest)));
  set(s.nearest, a, hn::Set(Ints(), static_cast<std::int32_t>(of_nearest)));
  const float of_a = hn::GetLane(nearest), of_other = hn::GetLane(other);
  const bool is_a = of_a < of_other || (of_a == of_other && a < slot);
  return is_a ? Candidate{a, of_nearest} : Candidate{slot, s.nearest[slot]};
}

/// Recomputes the bounds of slot a. Returns the new candidate.
template <int kVectors>
HWY_INLINE Candidate search(const AgglomerationState& s, Index a, Index pending) {
  const Floats d;
  const Index lanes = hn::Lanes(d);
  float* row = s.dissimilarity + a * s.stride;
  const float* only_later = s.only_later - a;
  set(s.nearest_value, a, hn::Set(d, kInfinity));
  if (kDefers<kVectors>) set(row, pending, hn::Set(d, s.dissimilarity[pending * s.stride + a]));
  Row<kVectors> later(s.scratch), bounds(s.nearest_value);
  for (Index v = 0; v < vectors<kVectors>(s.n); ++v) {
    const Index i = v * lanes;
    const auto value = hn::Add(hn::Load(d, row + i), hn::Load(d, s.gone + i));
    later.set(v, hn::Add(value, hn::LoadU(d, only_later + i)));
    if (kVectors > 0) bounds.set(v, hn::Load(d, s.nearest_value + i));
  }
  return conclude<kVectors>(s, a, later, bounds);
}

/// Stores row `column` as a column.
HWY_INLINE void store_column(const AgglomerationState& s, Index column) {
  const float* HWY_RESTRICT from = s.dissimilarity + column * s.stride;
  float* HWY_RESTRICT to = s.dissimilarity + column;
  const Index stride = s.stride;
  for (Index row = 0; row < s.n; row += 4, to += 4 * stride) {  // memory for three rows after the last
    to[0] = from[row];
    to[stride] = from[row + 1];
    to[2 * stride] = from[row + 2];
    to[3 * stride] = from[row + 3];
  }
}

/// Merges slot b into the earlier slot a, which is the new pending column. Returns the new candidate.
template <bool kIsWard, int kVectors>
HWY_INLINE Candidate merge(Linkage linkage, const AgglomerationState& s, Index a, Index b, Index pending) {
  const Floats d;
  const Ints di;
  const Index lanes = hn::Lanes(d), count = vectors<kVectors>(s.n);
  float* row_a = s.dissimilarity + a * s.stride;
  float* row_b = s.dissimilarity + b * s.stride;
  const float* row_pending = s.dissimilarity + pending * s.stride;
  const auto of_a = hn::Set(d, s.size[a]), of_b = hn::Set(d, s.size[b]), both = hn::Add(of_a, of_b);
  const auto between = hn::Set(d, s.nearest_value[a]), infinity = hn::Set(d, kInfinity);
  const auto largest = hn::Set(d, kLargest);
  const auto slot_a = hn::Set(di, static_cast<std::int32_t>(a)), slot_b = hn::Set(di, static_cast<std::int32_t>(b));
  const float *only_later = s.only_later - a, *only_earlier = s.only_earlier - a;
  s.merged_into[b] = a;
  set(s.gone, b, infinity);
  set(s.nearest_value, b, infinity);
  set(s.nearest_value, a, infinity);  // until conclude sets it
  set(s.nearest, a, hn::Set(di, kUnknown));
  set(s.nearest, b, hn::Set(di, kUnknown));
  if (kDefers<kVectors>) {
    set(row_a, pending, hn::Set(d, row_pending[a]));
    set(row_b, pending, hn::Set(d, row_pending[b]));
  }
  Row<kVectors> merged(row_a), later(s.scratch), bounds(s.nearest_value);
  auto any_nearer = hn::Lt(infinity, infinity);
  for (Index v = 0; v < count; ++v) {
    const Index i = v * lanes;
    const auto to_a = hn::Load(d, row_a + i), to_b = hn::Load(d, row_b + i);
    FloatVector value = infinity;
    switch (kIsWard ? Linkage::ward : linkage) {
      case Linkage::ward:
        if constexpr (kIsWard) {
          const auto size = hn::Load(d, s.size + i);
          const auto sum = hn::Add(hn::Mul(hn::Add(size, of_a), to_a), hn::Mul(hn::Add(size, of_b), to_b));
          value = hn::Div(hn::Sub(sum, hn::Mul(size, between)), hn::Add(size, both));
        }
        break;
      case Linkage::average:
        value = hn::Div(hn::Add(hn::Mul(of_a, to_a), hn::Mul(of_b, to_b)), both);
        break;
      case Linkage::complete:
        value = hn::Max(to_a, to_b);
        break;
      case Linkage::single:
        value = hn::Min(to_a, to_b);
        break;
    }
    value = hn::Add(value, hn::Load(d, s.gone + i));
    merged.set(v, value);
    later.set(v, hn::Add(value, hn::LoadU(d, only_later + i)));
    // The earlier slots whose nearest slot was a or b.
    const auto earlier = hn::Add(value, hn::LoadU(d, only_earlier + i));
    const auto nearest = hn::Load(di, s.nearest + i);
    const auto lost = hn::Or(hn::Eq(nearest, slot_a), hn::Eq(nearest, slot_b));
    const auto bound = hn::Load(d, s.nearest_value + i), next = hn::Load(d, s.next_value + i);
    const auto is_next = hn::Lt(earlier, next);
    const auto known = hn::IfThenElse(hn::RebindMask(di, is_next), slot_a, hn::Set(di, kUnknown));
    const auto new_bound = hn::IfThenElse(hn::RebindMask(d, lost), hn::Min(earlier, next), bound);
    bounds.set(v, new_bound);
    hn::Store(new_bound, d, s.nearest_value + i);
    hn::Store(hn::IfThenElse(lost, known, nearest), di, s.nearest + i);
    // After rounding, or in a tie. With single linkage the merged cluster is often as near as the second nearest slot.
    const auto nearer = kIsWard ? hn::Le(earlier, next) : hn::Or(is_next, hn::Le(earlier, hn::Min(bound, largest)));
    any_nearer = hn::Or(any_nearer, hn::AndNot(hn::RebindMask(d, lost), nearer));
  }
  if (HWY_UNLIKELY(!hn::AllFalse(d, any_nearer))) {
    for (Index v = 0; v < count; ++v) {
      const Index i = v * lanes;
      const auto earlier = hn::Add(merged.get(v), hn::LoadU(d, only_earlier + i));
      const auto bound = hn::Load(d, s.nearest_value + i), next = hn::Load(d, s.next_value + i);
      hn::Store(hn::Min(next, earlier), d, s.next_value + i);
      const auto nearer = hn::And(hn::Le(earlier, bound), hn::Lt(earlier, infinity));
      const auto nearest = hn::Load(di, s.nearest + i);
      // A slot that has just become the nearest one is known; to search it again does no harm.
      hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), hn::Set(di, kUnknown), nearest), di, s.nearest + i);
      bounds.set(v, hn::Min(bound, earlier));
      hn::Store(bounds.get(v), d, s.nearest_value + i);
    }
  }
  if (uses_sizes(kIsWard ? Linkage::ward : linkage)) set(s.size, a, both);
  if (kDefers<kVectors>) store_column(s, pending);
  if (kVectors > 0) {
    for (Index v = 0; v < count; ++v) hn::Store(merged.get(v), d, row_a + v * lanes);
  }
  const Candidate result = conclude<kVectors>(s, a, later, bounds);
  if (!kDefers<kVectors>) store_column(s, a);
  return result;
}

/// Ward's formula is compiled by itself. The others are so short that one body chooses among them for each vector.
template <bool kIsWard, int kVectors>
void agglomerate_by(Linkage linkage, Index k, const AgglomerationState& given) {
  const AgglomerationState s = given;  // a local copy, which the compiler knows no vector store to change
  start(linkage, s);
  Index pending = 0;
  Candidate next = search<kVectors>(s, 0, pending);
  for (Index clusters = s.n; clusters > k; --clusters) {
    while (next.nearest == kUnknown) next = search<kVectors>(s, next.slot, pending);
    const Index a = next.slot;
    next = merge<kIsWard, kVectors>(linkage, s, a, next.nearest, pending);
    pending = a;
  }
}

template <bool kIsWard, int... vectors>
constexpr auto agglomerations(std::integer_sequence<int, vectors...>) {
  return std::array{&agglomerate_by<kIsWard, vectors>...};
}

/// Loops over a known number of vectors are unrolled: that is worth its code if few vectors hold a problem.
template <bool kIsWard>
void agglomerate_by_vectors(Linkage linkage, Index k, const AgglomerationState& s) {
  constexpr int kMostUnrolled = hn::MaxLanes(Floats()) >= 8 ? 8 : 0;
  constexpr auto kByVectors = agglomerations<kIsWard>(std::make_integer_sequence<int, kMostUnrolled + 1>());
  const Index count = vectors<0>(s.n);
  kByVectors[static_cast<std::size_t>(count <= kMostUnrolled ? count : 0)](linkage, k, s);
}

void agglomerate_here(Linkage linkage, Index k, const AgglomerationState& s) {
  if (linkage == Linkage::ward)
    agglomerate_by_vectors<true>(linkage, k, s);
  else
    agglomerate_by_vectors<false>(linkage, k, s);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::semantics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::semantics {

HWY_EXPORT(agglomerate_here);

void agglomerate(Linkage linkage, Index k, AgglomerationState state) {
  HWY_DYNAMIC_DISPATCH(agglomerate_here)(linkage, k, state);
}

}  // namespace svnet::semantics
#endif
