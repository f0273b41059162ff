// The state of an agglomeration before its first merge: each slot holds one point. Included once for each instruction
// set.
#if defined(SVNET_AGGLOMERATE_START_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_AGGLOMERATE_START_INL_H_
#undef SVNET_AGGLOMERATE_START_INL_H_
#else
#define SVNET_AGGLOMERATE_START_INL_H_
#endif

#include <algorithm>
#include <cstdint>

#include <hwy/highway.h>

#include "semantics/agglomerate_rows-inl.h"
#include "semantics/agglomeration_state.h"
#include "semantics/linkage.h"
#include "semantics/lower_triangle.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::semantics {
namespace HWY_NAMESPACE {

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
  const auto infinity = hn::Set(d, kInfinity);
  for (Index j = 0; j < s.n; ++j) s.merged_into[j] = j;
  for (Index i = 0; i < s.stride; i += lanes) {
    const auto column = positions_from(i);
    auto value = hn::Set(d, kInfinity);
    auto next = hn::Set(d, kLargest);
    auto position = hn::Set(di, kUnknown);
    if (i < s.n) hn::Store(hn::Zero(d), d, s.dissimilarity + i * s.stride + i);
    for (Index j = i + 1; j < s.n; ++j) {
      float* row = s.dissimilarity + j * s.stride;
      const float* given = s.triangle == nullptr ? row : s.triangle + LowerTriangle::row_offset(j);
      const auto slot = hn::Set(di, static_cast<std::int32_t>(j));
      const auto inside = hn::RebindMask(d, hn::Lt(column, slot));
      auto here = hn::IfThenElseZero(inside, hn::Load(d, given + i));
      if (uses_roots(linkage)) here = hn::Sqrt(here);
      hn::Store(here, d, row + i);
      const auto candidate = hn::IfThenElse(inside, here, infinity), nearer_than = value;
      next = hn::Min(next, hn::Max(value, candidate));
      value = hn::Min(value, candidate);
      const auto nearer = hn::Lt(value, nearer_than);
      position = hn::IfThenElse(hn::RebindMask(di, nearer), slot, position);
    }
    hn::Store(value, d, s.nearest_value + i);
    hn::Store(next, d, s.next_value + i);
    hn::Store(position, di, s.nearest + i);
    hn::Store(hn::Set(d, 1.0f), d, s.size + i);
    const auto outside = hn::Gt(column, hn::Set(di, static_cast<std::int32_t>(s.n - 1)));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(d, outside), hn::Set(d, kInfinity)), d, s.gone + i);
  }
  mirror(s);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::semantics
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
