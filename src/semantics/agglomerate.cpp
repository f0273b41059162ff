// Greedy agglomeration with cached nearest neighbours, after Müllner, "Modern hierarchical, agglomerative clustering
// algorithms" (arXiv 1109.2378), section 3; updates by Lance and Williams (The Computer Journal 9, 1967).
//
// The linkages are reducible: a merged cluster is never nearer to a third than the nearer of its halves was. So what
// was once the distance of a slot to its nearest later slot stays a lower bound, and only a slot whose bound is the
// smallest of all is searched again, if its bound is out of date.
#include "semantics/agglomerate.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "semantics/agglomerate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vectors of at most a line of 16 floats, so that padded rows hold whole vectors.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using IntVector = hn::Vec<Ints>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// first, first + 1, … Not Iota(first), which the compiler builds in memory number by number.
HWY_INLINE IntVector positions_from(Index first) {
  return hn::Add(hn::Iota(Ints(), 0), hn::Set(Ints(), static_cast<std::int32_t>(first)));
}

/// The smallest value of lanes and positions seen so far; of equal ones the first.
struct Minimum {
  FloatVector value;
  IntVector position;

  Minimum()
      : value(hn::Set(Floats(), kInfinity)), position(hn::Set(Ints(), std::numeric_limits<std::int32_t>::max())) {}

  /// Positions must grow from call to call.
  HWY_INLINE void add(FloatVector values, IntVector positions) {
    const auto smaller = hn::Lt(values, value);
    value = hn::IfThenElse(smaller, values, value);
    position = hn::IfThenElse(hn::RebindMask(Ints(), smaller), positions, position);
  }
  /// Both end up in every lane. The position of infinity is the largest number.
  HWY_INLINE void reduce() {
    const auto smallest = hn::MinOfLanes(Floats(), value);
    const auto here = hn::RebindMask(Ints(), hn::Eq(value, smallest));
    const auto none = hn::Set(Ints(), std::numeric_limits<std::int32_t>::max());
    position = hn::MinOfLanes(Ints(), hn::IfThenElse(here, position, none));
    value = smallest;
  }
};

/// Fills the upper half from the lower one by squares of four, where there are vectors of four.
HWY_INLINE void mirror(const AgglomerationState& s) {
#if HWY_TARGET == HWY_SCALAR
  for (Index j = 0; j < s.n; ++j)
    for (Index i = 0; i < j; ++i) s.dissimilarity[i * s.stride + j] = s.dissimilarity[j * s.stride + i];
#else
  const hn::FixedTag<float, 4> d;
  const hn::RepartitionToWide<decltype(d)> pairs;
  for (Index j = 0; j < s.n; j += 4) {
    const float* row = s.dissimilarity + j * s.stride;  // below the last row there is memory, too
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

/// Fills the upper half from the lower one and finds the nearest later slot of each slot.
template <Linkage linkage>
HWY_INLINE void start(const AgglomerationState& s) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  for (Index i = 0; i < s.stride; i += lanes) {
    hn::Store(hn::Set(d, 1.0f), d, s.size + i);
    hn::Store(hn::Set(d, kInfinity), d, s.nearest_value + i);
    hn::Store(hn::Set(di, -1), di, s.nearest + i);
    const auto outside = hn::Gt(positions_from(i), hn::Set(di, static_cast<std::int32_t>(s.n - 1)));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(d, outside), hn::Set(d, kInfinity)), d, s.gone + i);
  }
  const float* next = s.triangle;
  for (Index j = 0; j < s.n; ++j) {
    s.merged_into[j] = static_cast<std::int32_t>(j);
    float* row = s.dissimilarity + j * s.stride;
    const float* from = s.triangle == nullptr ? row : next;
    next += s.triangle == nullptr ? 0 : (j + 15) / 16 * 16;
    const auto later = hn::Set(di, static_cast<std::int32_t>(j));
    for (Index i = 0; i < j; i += lanes) {
      auto value = hn::Load(d, from + i);
      const auto inside = hn::RebindMask(d, hn::Lt(positions_from(i), later));
      value = hn::IfThenElseZero(inside, value);
      if (linkage == Linkage::average) value = hn::Sqrt(value);
      hn::Store(value, d, row + i);
      const auto best = hn::Load(d, s.nearest_value + i);
      const auto nearer = hn::And(inside, hn::Lt(value, best));
      hn::Store(hn::IfThenElse(nearer, value, best), d, s.nearest_value + i);
      hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), later, hn::Load(di, s.nearest + i)), di, s.nearest + i);
    }
    row[j] = 0;
  }
  mirror(s);
}

/// values[slot] = value, by a whole vector: a vector load that follows would have to wait for a narrower store.
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

HWY_INLINE void find_nearest(const AgglomerationState& s, Index a) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  const float* row = s.dissimilarity + a * s.stride;
  const auto slot = hn::Set(di, static_cast<std::int32_t>(a)), step = hn::Set(di, static_cast<std::int32_t>(lanes));
  const Index first = a & -lanes;
  auto position = positions_from(first);
  Minimum nearest;
  nearest.add(hn::IfThenElse(hn::RebindMask(d, hn::Gt(position, slot)),
                             hn::Add(hn::Load(d, row + first), hn::Load(d, s.gone + first)), hn::Set(d, kInfinity)),
              position);
  for (Index i = first + lanes; i < s.n; i += lanes) {
    position = hn::Add(position, step);
    nearest.add(hn::Add(hn::Load(d, row + i), hn::Load(d, s.gone + i)), position);
  }
  nearest.reduce();
  set(s.nearest_value, a, nearest.value);
  set(s.nearest, a, nearest.position);
}

/// The slot with the smallest bound; of equal ones the first.
HWY_INLINE Index smallest_bound(const AgglomerationState& s) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  const auto step = hn::Set(di, static_cast<std::int32_t>(lanes));
  auto position = hn::Iota(di, 0);
  Minimum smallest;
  for (Index i = 0; i < s.n; i += lanes, position = hn::Add(position, step))
    smallest.add(hn::Load(d, s.nearest_value + i), position);
  smallest.reduce();
  return hn::GetLane(smallest.position);
}

HWY_INLINE bool up_to_date(const AgglomerationState& s, Index a) {
  const Index b = s.nearest[a];
  return s.gone[b] == 0 && s.dissimilarity[a * s.stride + b] == s.nearest_value[a];
}

/// Merges slot b into the earlier slot a; returns the slot with the smallest bound afterwards.
template <Linkage linkage>
HWY_INLINE Index merge(const AgglomerationState& s, Index a, Index b) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  float* HWY_RESTRICT row_a = s.dissimilarity + a * s.stride;
  const float* HWY_RESTRICT row_b = s.dissimilarity + b * s.stride;
  const auto of_a = hn::Set(d, s.size[a]), of_b = hn::Set(d, s.size[b]), both = hn::Add(of_a, of_b);
  const auto between = hn::Set(d, row_a[b]), infinity = hn::Set(d, kInfinity);
  const auto slot_a = hn::Set(di, static_cast<std::int32_t>(a)), step = hn::Set(di, static_cast<std::int32_t>(lanes));
  s.merged_into[b] = static_cast<std::int32_t>(a);
  set(s.gone, b, infinity);
  set(s.nearest_value, b, infinity);
  set(s.nearest_value, a, infinity);  // until it is known again

  auto position = hn::Iota(di, 0);
  Minimum nearest, smallest;
  /// The distances from the merged cluster to the slots of a vector, infinite where they are gone.
  const auto merged = [&](Index i) HWY_ATTR {
    const auto to_a = hn::Load(d, row_a + i), to_b = hn::Load(d, row_b + i);
    FloatVector value;
    if constexpr (linkage == Linkage::ward) {
      const auto size = hn::Load(d, s.size + i);
      const auto sum = hn::Add(hn::Mul(hn::Add(size, of_a), to_a), hn::Mul(hn::Add(size, of_b), to_b));
      value = hn::Div(hn::Sub(sum, hn::Mul(size, between)), hn::Add(size, both));
    } else if constexpr (linkage == Linkage::average) {
      value = hn::Div(hn::Add(hn::Mul(of_a, to_a), hn::Mul(of_b, to_b)), both);
    } else if constexpr (linkage == Linkage::complete) {
      value = hn::Max(to_a, to_b);
    } else {
      value = hn::Min(to_a, to_b);
    }
    hn::Store(value, d, row_a + i);
    return hn::Add(value, hn::Load(d, s.gone + i));
  };
  /// Earlier slots may find the merged cluster nearest, by rounding or in a tie.
  const auto update_bounds = [&](Index i, FloatVector value, auto allowed) HWY_ATTR {
    const auto bound = hn::Load(d, s.nearest_value + i);
    const auto of_bound = hn::Load(di, s.nearest + i);
    const auto tied = hn::And(hn::Eq(value, bound), hn::RebindMask(d, hn::Gt(of_bound, slot_a)));
    const auto nearer = allowed(hn::Or(hn::Lt(value, bound), tied));
    const auto new_bound = hn::IfThenElse(nearer, value, bound);
    hn::Store(new_bound, d, s.nearest_value + i);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), slot_a, of_bound), di, s.nearest + i);
    smallest.add(new_bound, position);
  };
  const Index vector_of_a = a & -lanes;
  Index i = 0;
  for (; i < vector_of_a; i += lanes, position = hn::Add(position, step))
    update_bounds(i, merged(i), [](auto nearer) HWY_ATTR { return nearer; });
  const auto value = merged(i);
  update_bounds(i, value,
                [&](auto nearer) HWY_ATTR { return hn::And(nearer, hn::RebindMask(d, hn::Gt(slot_a, position))); });
  nearest.add(hn::IfThenElse(hn::RebindMask(d, hn::Gt(position, slot_a)), value, infinity), position);
  for (i += lanes, position = hn::Add(position, step); i < s.n; i += lanes, position = hn::Add(position, step)) {
    nearest.add(merged(i), position);
    smallest.add(hn::Load(d, s.nearest_value + i), position);
  }
  nearest.reduce();
  smallest.reduce();
  set(s.nearest_value, a, nearest.value);
  set(s.nearest, a, nearest.position);
  if (linkage == Linkage::ward || linkage == Linkage::average) set(s.size, a, both);

  float* HWY_RESTRICT to = s.dissimilarity + a;
  const Index stride = s.stride;
  for (Index row = 0; row < s.n; row += 4, to += 4 * stride) {  // below the last row there is memory, too
    to[0] = row_a[row];
    to[stride] = row_a[row + 1];
    to[2 * stride] = row_a[row + 2];
    to[3 * stride] = row_a[row + 3];
  }
  const float of_slot_a = hn::GetLane(nearest.value), of_others = hn::GetLane(smallest.value);
  const Index other = hn::GetLane(smallest.position);
  return of_slot_a < of_others || (of_slot_a == of_others && a < other) ? a : other;
}

template <Linkage linkage>
void agglomerate_by(Index k, const AgglomerationState& given) {
  const AgglomerationState s = given;  // vector stores may alias what they do not know to be here alone
  start<linkage>(s);
  Index a = smallest_bound(s);
  for (Index clusters = s.n; clusters > k; --clusters) {
    while (!up_to_date(s, a)) {
      find_nearest(s, a);
      a = smallest_bound(s);
    }
    a = merge<linkage>(s, a, s.nearest[a]);
  }
}

void agglomerate_here(Linkage linkage, Index k, const AgglomerationState& s) {
  switch (linkage) {
    case Linkage::ward:
      return agglomerate_by<Linkage::ward>(k, s);
    case Linkage::average:
      return agglomerate_by<Linkage::average>(k, s);
    case Linkage::complete:
      return agglomerate_by<Linkage::complete>(k, s);
    case Linkage::single:
      return agglomerate_by<Linkage::single>(k, s);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet {

HWY_EXPORT(agglomerate_here);

void agglomerate(Linkage linkage, Index k, AgglomerationState state) {
  HWY_DYNAMIC_DISPATCH(agglomerate_here)(linkage, k, state);
}

}  // namespace svnet
#endif
