// Greedy agglomeration with cached nearest neighbours, after Müllner, "Modern hierarchical, agglomerative clustering
// algorithms" (arXiv 1109.2378), section 3; updates by Lance and Williams (The Computer Journal 9, 1967).
//
// The linkages are reducible: a merged cluster is never nearer to a third than the nearer of its halves was. So what
// was once the distance of a slot to its nearest later slot stays a lower bound, and only a slot whose bound is the
// smallest of all is searched again, if its bound is out of date.
#include "semantics/agglomerate.h"

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

/// The smallest value of lanes and positions seen so far; of equal ones the first.
struct Minimum {
  FloatVector value;
  IntVector position;

  Minimum()
      : value(hn::Set(Floats(), kInfinity)), position(hn::Set(Ints(), std::numeric_limits<std::int32_t>::max())) {}

  /// Positions must grow from call to call.
  HWY_INLINE void add(FloatVector values, IntVector positions) {
    const auto smaller = hn::Lt(values, value);
    value = hn::Min(values, value);
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
    const auto outside =
        hn::Gt(hn::Iota(di, static_cast<std::int32_t>(i)), hn::Set(di, static_cast<std::int32_t>(s.n - 1)));
    hn::Store(hn::IfThenElseZero(hn::RebindMask(d, outside), hn::Set(d, kInfinity)), d, s.gone + i);
  }
  for (Index j = 0; j < s.n; ++j) {
    s.merged_into[j] = static_cast<std::int32_t>(j);
    float* row = s.dissimilarity + j * s.stride;
    const auto later = hn::Set(di, static_cast<std::int32_t>(j));
    for (Index i = 0; i < j; i += lanes) {
      auto value = hn::Load(d, row + i);
      const auto inside = hn::RebindMask(d, hn::Lt(hn::Iota(di, static_cast<std::int32_t>(i)), later));
      value = hn::IfThenElseZero(inside, value);
      if (linkage == Linkage::average) value = hn::Sqrt(value);
      hn::Store(value, d, row + i);
      const auto best = hn::Load(d, s.nearest_value + i);
      const auto nearer = hn::And(inside, hn::Lt(value, best));
      hn::Store(hn::IfThenElse(nearer, value, best), d, s.nearest_value + i);
      hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), later, hn::Load(di, s.nearest + i)), di, s.nearest + i);
    }
    row[j] = 0;
    for (Index i = 0; i < j; ++i) s.dissimilarity[i * s.stride + j] = row[i];
  }
}

HWY_INLINE void find_nearest(const AgglomerationState& s, Index a) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  const float* row = s.dissimilarity + a * s.stride;
  const auto slot = hn::Set(di, static_cast<std::int32_t>(a));
  Minimum nearest;
  for (Index i = (a + 1) / lanes * lanes; i < s.n; i += lanes) {
    const auto position = hn::Iota(di, static_cast<std::int32_t>(i));
    const auto value = hn::Add(hn::Load(d, row + i), hn::Load(d, s.gone + i));
    nearest.add(hn::IfThenElse(hn::RebindMask(d, hn::Gt(position, slot)), value, hn::Set(d, kInfinity)), position);
  }
  nearest.reduce();
  s.nearest_value[a] = hn::GetLane(nearest.value);
  s.nearest[a] = hn::GetLane(nearest.position);
}

/// The two clusters that are nearest to each other; of equally near pairs the one whose lower slot comes first.
HWY_INLINE Index nearest_pair(const AgglomerationState& s) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  for (;;) {
    Minimum pair;
    for (Index i = 0; i < s.n; i += lanes)
      pair.add(hn::Load(d, s.nearest_value + i), hn::Iota(di, static_cast<std::int32_t>(i)));
    pair.reduce();
    const Index a = hn::GetLane(pair.position), b = s.nearest[a];
    if (s.gone[b] == 0 && s.dissimilarity[a * s.stride + b] == s.nearest_value[a]) return a;
    find_nearest(s, a);
  }
}

template <Linkage linkage>
HWY_INLINE void merge(const AgglomerationState& s, Index a, Index b) {
  const Floats d;
  const Ints di;
  const auto lanes = static_cast<Index>(hn::Lanes(d));
  float* row_a = s.dissimilarity + a * s.stride;
  const float* row_b = s.dissimilarity + b * s.stride;
  const float size_a = s.size[a], size_b = s.size[b];
  const auto between = hn::Set(d, row_a[b]), both = hn::Set(d, size_a + size_b);
  const auto of_a = hn::Set(d, size_a), of_b = hn::Set(d, size_b);
  const auto slot_a = hn::Set(di, static_cast<std::int32_t>(a));
  s.merged_into[b] = static_cast<std::int32_t>(a);
  s.gone[b] = s.nearest_value[b] = kInfinity;
  s.nearest[b] = -1;
  Minimum nearest;
  for (Index i = 0; i < s.n; i += lanes) {
    const auto to_a = hn::Load(d, row_a + i), to_b = hn::Load(d, row_b + i);
    FloatVector merged;
    if constexpr (linkage == Linkage::ward) {
      const auto size = hn::Load(d, s.size + i);
      const auto sum = hn::Add(hn::Mul(hn::Add(size, of_a), to_a), hn::Mul(hn::Add(size, of_b), to_b));
      merged = hn::Div(hn::Sub(sum, hn::Mul(size, between)), hn::Add(size, both));
    } else if constexpr (linkage == Linkage::average) {
      merged = hn::Div(hn::Add(hn::Mul(of_a, to_a), hn::Mul(of_b, to_b)), both);
    } else if constexpr (linkage == Linkage::complete) {
      merged = hn::Max(to_a, to_b);
    } else {
      merged = hn::Min(to_a, to_b);
    }
    hn::Store(merged, d, row_a + i);
    const auto position = hn::Iota(di, static_cast<std::int32_t>(i));
    const auto value = hn::Add(merged, hn::Load(d, s.gone + i));
    // Earlier slots may find the merged cluster nearest, by rounding or in a tie.
    const auto bound = hn::Load(d, s.nearest_value + i);
    const auto of_bound = hn::Load(di, s.nearest + i);
    const auto earlier = hn::RebindMask(d, hn::Lt(position, slot_a));
    const auto tied = hn::And(hn::Eq(value, bound), hn::RebindMask(d, hn::Lt(slot_a, of_bound)));
    const auto nearer = hn::And(earlier, hn::Or(hn::Lt(value, bound), tied));
    hn::Store(hn::IfThenElse(nearer, value, bound), d, s.nearest_value + i);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, nearer), slot_a, of_bound), di, s.nearest + i);
    const auto later = hn::RebindMask(d, hn::Gt(position, slot_a));
    nearest.add(hn::IfThenElse(later, value, hn::Set(d, kInfinity)), position);
  }
  nearest.reduce();
  s.nearest_value[a] = hn::GetLane(nearest.value);
  s.nearest[a] = hn::GetLane(nearest.position);
  s.size[a] = size_a + size_b;
  float* column = s.dissimilarity + a;
  for (Index i = 0; i < s.n; ++i) column[i * s.stride] = row_a[i];
}

template <Linkage linkage>
void agglomerate_by(Index k, const AgglomerationState& s) {
  start<linkage>(s);
  for (Index clusters = s.n; clusters > k; --clusters) {
    const Index a = nearest_pair(s);
    merge<linkage>(s, a, s.nearest[a]);
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
