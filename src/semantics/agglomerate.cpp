// Greedy agglomeration with cached nearest neighbours, after Müllner, "Modern hierarchical, agglomerative clustering
// algorithms" (arXiv 1109.2378), section 3; updates by Lance and Williams (The Computer Journal 9, 1967).
//
// The linkages are reducible: a merged cluster is never nearer to a third cluster than the nearer of its two parts was.
// So the distance of a slot to its nearest later slot, once computed, stays a lower bound. Only the slot with the
// smallest bound is searched again, and only if its bound is out of date.
#include "semantics/agglomerate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "semantics/lower_triangle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semantics/agglomerate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

/// Whether the dissimilarities are distances; otherwise they are squared distances.
constexpr bool uses_roots(Linkage linkage) {
  switch (linkage) {
    case Linkage::average:
      return true;
    case Linkage::ward:
    case Linkage::complete:
    case Linkage::single:
      return false;
  }
  return false;
}

// At most 16 lanes, so that padded rows hold whole vectors.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using IntVector = hn::Vec<Ints>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// first, first + 1, … Iota(first) would be slower: the compiler builds it in memory, lane by lane.
HWY_INLINE IntVector positions_from(Index first) {
  return hn::Add(hn::Iota(Ints(), 0), hn::Set(Ints(), static_cast<std::int32_t>(first)));
}

/// Returns a mask as an integer; bit i is lane i.
HWY_INLINE std::uint64_t bits_of(hn::Mask<Floats> mask) {
  std::uint8_t bytes[8];
  hn::StoreMaskBits(Floats(), mask, bytes);
  if constexpr (hn::MaxLanes(Floats()) > 8) return std::uint64_t{bytes[0]} | std::uint64_t{bytes[1]} << 8;
  return bytes[0];
}

/// The number of vectors that hold all slots: kVectors if it is known at compile time, that is, not 0.
template <int kVectors>
HWY_INLINE Index vectors(const AgglomerationState& s) {
  const Index lanes = hn::Lanes(Floats());
  return kVectors > 0 ? kVectors : (s.n + lanes - 1) / lanes;
}

/// Returns the first slot after slot `after` (-1: of all slots) whose value is `wanted`, or n if there is none. No
/// branch depends on the values.
template <int kVectors>
HWY_INLINE Index first_equal(const AgglomerationState& s, const float* values, Index after, FloatVector wanted) {
  const Floats d;
  const Index lanes = hn::Lanes(d), count = vectors<kVectors>(s), of_word = 64 / lanes;
  Index found = s.n;
  for (Index v0 = (count - 1) / of_word * of_word; v0 >= 0; v0 -= of_word) {
    std::uint64_t bits = 0;
    for (Index v = v0; v < std::min(count, v0 + of_word); ++v)
      bits |= bits_of(hn::Eq(hn::Load(d, values + v * lanes), wanted)) << ((v - v0) * lanes);
    const Index base = v0 * lanes, before = after - base;
    const std::uint64_t later = ~std::uint64_t{0} << (before & 63) << 1;
    bits &= before < 0 ? ~std::uint64_t{0} : before > 63 ? 0 : later;
    found = bits != 0 ? base + std::countr_zero(bits) : found;
  }
  return found;
}

/// Copies the part below the diagonal to the part above it, in blocks of 4 x 4 if there are vectors of 4 lanes.
HWY_INLINE void mirror(const AgglomerationState& s) {
#if HWY_TARGET == HWY_SCALAR
  for (Index j = 0; j < s.n; ++j)
    for (Index i = 0; i < j; ++i) s.dissimilarity[i * s.stride + j] = s.dissimilarity[j * s.stride + i];
#else
  const hn::FixedTag<float, 4> d;
  const hn::RepartitionToWide<decltype(d)> pairs;
  for (Index j = 0; j < s.n; j += 4) {
    const float* row = s.dissimilarity + j * s.stride;  // there is memory for three rows after the last one
    for (Index i = 0; i < j; i += 4) {
      const auto r0 = hn::Load(d, row + i), r1 = hn::Load(d, row + s.stride + i);
      const auto r2 = hn::Load(d, row + 2 * s.stride + i), r3 = hn::Load(d, row + 3 * s.stride + i);
      const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, r0, r1));
      const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(d, r2, r3));
      const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, r0, r1));
      const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, r2, r3));
      float* to = s.dissimilarity + i * s.stride + j;
      hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23)), d, to);
      hn::Store(hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23)), d, to + s.stride);
      hn::Store(hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23)), d, to + 2 * s.stride);
      hn::Store(hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23)), d, to + 3 * s.stride);
    }
    for (Index r = 1; r < std::min<Index>(4, s.n - j); ++r)
      for (Index c = 0; c < r; ++c) s.dissimilarity[(j + c) * s.stride + j + r] = row[r * s.stride + j + c];
  }
#endif
}

/// Copies the input distances below the diagonal, mirrors them, and finds the nearest later slot of each slot.
HWY_NOINLINE void start(Linkage linkage, const AgglomerationState& s) {
  const Floats d;
  const Ints di;
  const Index lanes = hn::Lanes(d);
  for (Index j = 0; j < s.n; ++j) s.merged_into[j] = j;
  for (Index i = 0; i < s.stride; i += lanes) {
    const auto column = positions_from(i);
    auto value = hn::Set(d, kInfinity);
    auto position = hn::Set(di, -1);
    if (i < s.n) hn::Store(hn::Zero(d), d, s.dissimilarity + i * s.stride + i);
    for (Index j = i + 1; j < s.n; ++j) {
      float* row = s.dissimilarity + j * s.stride;
      const float* given = s.triangle == nullptr ? row : s.triangle + LowerTriangle::row_offset(j);
      const auto slot = hn::Set(di, static_cast<std::int32_t>(j));
      const auto inside = hn::RebindMask(d, hn::Lt(column, slot));
      auto here = hn::IfThenElseZero(inside, hn::Load(d, given + i));
      if (uses_roots(linkage)) here = hn::Sqrt(here);
      hn::Store(here, d, row + i);
      const auto nearer = hn::And(inside, hn::Lt(here, value));
      value = hn::IfThenElse(nearer, here, value);
      position = hn::IfThenElse(hn::RebindMask(di, nearer), slot, position);
    }
    hn::Store(value, d, s.nearest_value + i);
    hn::Store(position, di, s.nearest + i);
    hn::Store(hn::Set(d, 1.0f), d, s.size + i);
    const auto outside = hn::Gt(column, hn::Set(di, static_cast<std::int32_t>(s.n - 1)));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(d, outside), hn::Set(d, kInfinity)), d, s.gone + i);
  }
  mirror(s);
}

/// values[slot] = value. Stores a whole vector, because a later vector load would stall on a narrower store.
HWY_INLINE void set(float* values, Index slot, FloatVector value) {
  const Floats d;
  const Index first = slot & -static_cast<Index>(hn::Lanes(d));
  const auto lane = hn::Eq(hn::Iota(Ints(), 0), hn::Set(Ints(), static_cast<std::int32_t>(slot - first)));
  hn::Store(hn::IfThenElse(hn::RebindMask(d, lane), value, hn::Load(d, values + first)), d, values + first);
}
HWY_INLINE void set(std::int32_t* values, Index slot, IntVector value) {
  const Ints d;
  const Index first = slot & -static_cast<Index>(hn::Lanes(d));
  const auto lane = hn::Eq(hn::Iota(d, 0), hn::Set(d, static_cast<std::int32_t>(slot - first)));
  hn::Store(hn::IfThenElse(lane, value, hn::Load(d, values + first)), d, values + first);
}

/// Two clusters that may be the nearest pair: a slot, and the later slot that its bound refers to.
struct Candidate {
  Index slot, nearest;
};

/// The smallest value of all slots, and the first slot that has it.
struct Smallest {
  FloatVector value;  // in every lane
  Index slot;
};

template <int kVectors>
HWY_INLINE Smallest smallest_bound(const AgglomerationState& s) {
  const Floats d;
  const Index lanes = hn::Lanes(d);
  auto value = hn::Load(d, s.nearest_value);
  for (Index v = 1; v < vectors<kVectors>(s); ++v) value = hn::Min(value, hn::Load(d, s.nearest_value + v * lanes));
  value = hn::MinOfLanes(d, value);
  return {value, first_equal<kVectors>(s, s.nearest_value, -1, value)};
}

HWY_INLINE bool up_to_date(const AgglomerationState& s, const Candidate& c) {
  return s.gone[c.nearest] == 0 && s.dissimilarity[c.slot * s.stride + c.nearest] == s.nearest_value[c.slot];
}

/// Sets the nearest later slot of slot a; its distance is the smallest lane of `later`. `other` is the smallest bound
/// of the other slots. Returns the candidate of a or of `other`, whichever bound is smaller.
template <int kVectors>
HWY_INLINE Candidate conclude(const AgglomerationState& s, Index a, FloatVector later, const Smallest& other) {
  later = hn::MinOfLanes(Floats(), later);
  const Index nearest = first_equal<kVectors>(s, s.dissimilarity + a * s.stride, a, later);
  set(s.nearest_value, a, later);
  set(s.nearest, a, hn::Set(Ints(), static_cast<std::int32_t>(nearest)));
  const float of_a = hn::GetLane(later), of_other = hn::GetLane(other.value);
  const bool is_a = of_a < of_other || (of_a == of_other && a < other.slot);
  return is_a ? Candidate{a, nearest} : Candidate{other.slot, s.nearest[other.slot]};
}

/// Recomputes the bound of slot a. Returns the new candidate.
template <int kVectors>
HWY_INLINE Candidate search(const AgglomerationState& s, Index a) {
  const Floats d;
  const Ints di;
  const Index lanes = hn::Lanes(d);
  const auto infinity = hn::Set(d, kInfinity);
  set(s.nearest_value, a, infinity);
  const Smallest other = smallest_bound<kVectors>(s);
  float* row = s.dissimilarity + a * s.stride;
  const auto slot_a = hn::Set(di, static_cast<std::int32_t>(a)), step = hn::Set(di, static_cast<std::int32_t>(lanes));
  auto later = infinity;
  auto position = hn::Iota(di, 0);
  for (Index v = 0; v < vectors<kVectors>(s); ++v, position = hn::Add(position, step)) {
    const Index i = v * lanes;
    const auto value = hn::Add(hn::Load(d, row + i), hn::Load(d, s.gone + i));
    hn::Store(value, d, row + i);
    later = hn::Min(later, hn::IfThenElse(hn::RebindMask(d, hn::Gt(position, slot_a)), value, infinity));
  }
  return conclude<kVectors>(s, a, later, other);
}

/// Merges slot b into the earlier slot a. Returns the new candidate.
template <bool kIsWard, int kVectors>
HWY_INLINE Candidate merge(Linkage linkage, const AgglomerationState& s, Index a, Index b) {
  const Floats d;
  const Ints di;
  const Index lanes = hn::Lanes(d);
  float* HWY_RESTRICT row_a = s.dissimilarity + a * s.stride;
  const float* HWY_RESTRICT row_b = s.dissimilarity + b * s.stride;
  const auto of_a = hn::Set(d, s.size[a]), of_b = hn::Set(d, s.size[b]), both = hn::Add(of_a, of_b);
  const auto between = hn::Set(d, row_a[b]), infinity = hn::Set(d, kInfinity);
  const auto slot_a = hn::Set(di, static_cast<std::int32_t>(a)), step = hn::Set(di, static_cast<std::int32_t>(lanes));
  s.merged_into[b] = a;
  set(s.gone, b, infinity);
  set(s.nearest_value, b, infinity);
  set(s.nearest_value, a, infinity);  // until conclude sets it
  Smallest other = smallest_bound<kVectors>(s);

  auto later = infinity;
  auto any_nearer = hn::Lt(infinity, infinity);
  auto position = hn::Iota(di, 0);
  /// The earlier slots for which the merged cluster is now the nearest: possible after rounding, or in a tie.
  const auto finds_it_nearer = [&](Index i, FloatVector value) HWY_ATTR {
    const auto bound = hn::Load(d, s.nearest_value + i);
    const auto tied = hn::And(hn::Eq(value, bound), hn::RebindMask(d, hn::Gt(hn::Load(di, s.nearest + i), slot_a)));
    return hn::And(hn::Lt(value, infinity),
                   hn::And(hn::RebindMask(d, hn::Gt(slot_a, position)), hn::Or(hn::Lt(value, bound), tied)));
  };
  for (Index v = 0; v < vectors<kVectors>(s); ++v, position = hn::Add(position, step)) {
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
    hn::Store(value, d, row_a + i);
    any_nearer = hn::Or(any_nearer, finds_it_nearer(i, value));
    later = hn::Min(later, hn::IfThenElse(hn::RebindMask(d, hn::Gt(position, slot_a)), value, infinity));
  }
  if (HWY_UNLIKELY(!hn::AllFalse(d, any_nearer))) {
    position = hn::Iota(di, 0);
    for (Index v = 0; v < vectors<kVectors>(s); ++v, position = hn::Add(position, step)) {
      const Index i = v * lanes;
      const auto value = hn::Load(d, row_a + i);
      const auto nearer = finds_it_nearer(i, value);
      hn::Store(hn::IfThenElse(nearer, value, hn::Load(d, s.nearest_value + i)), d, s.nearest_value + i);
      hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), slot_a, hn::Load(di, s.nearest + i)), di, s.nearest + i);
    }
    other = smallest_bound<kVectors>(s);
  }
  if (uses_sizes(kIsWard ? Linkage::ward : linkage)) set(s.size, a, both);
  const Candidate next = conclude<kVectors>(s, a, later, other);

  float* HWY_RESTRICT to = s.dissimilarity + a;
  const Index stride = s.stride;
  for (Index row = 0; row < s.n; row += 4, to += 4 * stride) {  // memory for three rows after the last
    to[0] = row_a[row];
    to[stride] = row_a[row + 1];
    to[2 * stride] = row_a[row + 2];
    to[3 * stride] = row_a[row + 3];
  }
  return next;
}

/// Ward's formula is compiled by itself. The others are so short that one body chooses among them for each vector.
template <bool kIsWard, int kVectors>
void agglomerate_by(Linkage linkage, Index k, const AgglomerationState& given) {
  const AgglomerationState s = given;  // a local copy, which the compiler knows no vector store to change
  start(linkage, s);
  const Index first = smallest_bound<kVectors>(s).slot;
  Candidate next{first, s.nearest[first]};
  for (Index clusters = s.n; clusters > k; --clusters) {
    while (!up_to_date(s, next)) next = search<kVectors>(s, next.slot);
    next = merge<kIsWard, kVectors>(linkage, s, next.slot, next.nearest);
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
  const Index count = vectors<0>(s);
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
