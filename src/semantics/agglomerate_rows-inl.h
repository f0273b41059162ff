// Vectors of the values of slots, as agglomerate.cpp keeps them: one value per slot, a slot per lane. Included once for
// each instruction set.
#if defined(SVNET_AGGLOMERATE_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_AGGLOMERATE_ROWS_INL_H_
#undef SVNET_AGGLOMERATE_ROWS_INL_H_
#else
#define SVNET_AGGLOMERATE_ROWS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#include "base/index.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::semantics {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most 16 lanes, so that padded rows hold whole vectors.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using IntVector = hn::Vec<Ints>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();
constexpr std::int32_t kUnknown = -1;

/// first, first + 1, … Iota(first) would be slower: the compiler builds it in memory, lane by lane.
HWY_INLINE IntVector positions_from(Index first) {
  return hn::Add(hn::Iota(Ints(), 0), hn::Set(Ints(), static_cast<std::int32_t>(first)));
}

/// Returns a mask as an integer; bit i is lane i.
HWY_INLINE std::uint64_t bits_of(hn::Mask<Floats> mask) {
  std::uint8_t bytes[8];
  hn::StoreMaskBits(Floats(), mask, bytes);
  if constexpr (hn::MaxLanes(Floats()) > 8) {
    std::uint16_t both;  // little-endian, as every machine with such vectors
    std::memcpy(&both, bytes, sizeof both);
    return both;
  }
  return bytes[0];
}

/// The number of vectors that hold n slots: kVectors if it is known at compile time, that is, not 0.
template <int kVectors>
HWY_INLINE Index vectors(Index n) {
  const Index lanes = hn::Lanes(Floats());
  return kVectors > 0 ? kVectors : (n + lanes - 1) / lanes;
}

/// values[slot] = value. Stores a whole vector, because a later vector load would stall on a narrower store, and on a
/// masked one: so the two parts are joined by Or, which the compiler cannot make a masked store of.
HWY_INLINE void set(float* values, Index slot, FloatVector value) {
  const Floats d;
  const Index first = slot & -static_cast<Index>(hn::Lanes(d));
  const auto lane =
      hn::RebindMask(d, hn::Eq(hn::Iota(Ints(), 0), hn::Set(Ints(), static_cast<std::int32_t>(slot - first))));
  const auto others = hn::IfThenZeroElse(lane, hn::Load(d, values + first));
  hn::Store(hn::Or(hn::IfThenElseZero(lane, value), others), d, values + first);
}
HWY_INLINE void set(std::int32_t* values, Index slot, IntVector value) {
  const Ints d;
  const Index first = slot & -static_cast<Index>(hn::Lanes(d));
  const auto lane = hn::Eq(hn::Iota(d, 0), hn::Set(d, static_cast<std::int32_t>(slot - first)));
  const auto others = hn::IfThenZeroElse(lane, hn::Load(d, values + first));
  hn::Store(hn::Or(hn::IfThenElseZero(lane, value), others), d, values + first);
}

/// A value per slot, in registers if the number of vectors is known.
template <int kVectors>
struct Row {
  FloatVector at[kVectors];

  explicit Row(float*) {}
  HWY_INLINE FloatVector get(Index v) const { return at[v]; }
  HWY_INLINE void set(Index v, FloatVector value) { at[v] = value; }
};
template <>
struct Row<0> {
  float* memory;

  explicit Row(float* scratch) : memory(scratch) {}
  HWY_INLINE FloatVector get(Index v) const {
    return hn::Load(Floats(), memory + v * static_cast<Index>(hn::Lanes(Floats())));
  }
  HWY_INLINE void set(Index v, FloatVector value) {
    hn::Store(value, Floats(), memory + v * static_cast<Index>(hn::Lanes(Floats())));
  }
};

/// Returns the first slot whose value is `wanted`; one must have it. is_only, if not null: whether no other slot has
/// it.
template <int kVectors>
HWY_INLINE Index first_equal(Index n, const Row<kVectors>& values, FloatVector wanted, bool* is_only) {
  const Index lanes = hn::Lanes(Floats()), count = vectors<kVectors>(n), of_word = 64 / lanes;
  Index found = 0;
  std::uint64_t bits_found = 0;
  for (Index v0 = (count - 1) / of_word * of_word; v0 >= 0; v0 -= of_word) {
    std::uint64_t bits = 0;
    for (Index v = v0; v < std::min(count, v0 + of_word); ++v)
      bits |= bits_of(hn::Eq(values.get(v), wanted)) << ((v - v0) * lanes);
    found = bits != 0 ? v0 * lanes + std::countr_zero(bits) : found;
    bits_found = bits_found != 0 && bits != 0 ? ~std::uint64_t{0} : bits_found | bits;
  }
  if (is_only != nullptr) *is_only = (bits_found & (bits_found - 1)) == 0;
  return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::semantics
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
