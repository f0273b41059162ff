// Vectors of a panel's channels, and what is done to them. Included once for each instruction set by the kernels that
// work on panels.
#if defined(SVNET_PANEL_VECTOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_PANEL_VECTOR_INL_H_
#undef SVNET_PANEL_VECTOR_INL_H_
#else
#define SVNET_PANEL_VECTOR_INL_H_
#endif

#include <algorithm>
#include <utility>

#include <hwy/highway.h>

#include "base/aligned.h"
#include "nn/kernels/packed/panel.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A whole panel in one vector, if the machine has vectors that wide.
using PanelTag = hn::CappedTag<float, kPanel>;
using PanelVector = hn::Vec<PanelTag>;
inline constexpr int kVectorsPerPanel = static_cast<int>(kPanel / hn::MaxLanes(PanelTag()));
inline constexpr Index kLanes = kPanel / kVectorsPerPanel;

/// Calls body(std::integral_constant<int, i>) for i = 0, …, kCount - 1 without a loop: the compiler knows each i.
template <class Body, int... i>
HWY_INLINE void unrolled(Body&& body, std::integer_sequence<int, i...>) {
  (body(std::integral_constant<int, i>{}), ...);
}
template <int kCount, class Body>
HWY_INLINE void unrolled(Body&& body) {
  unrolled(body, std::make_integer_sequence<int, kCount>{});
}

/// Elementwise maximum of low and y; a NaN in y stays.
template <class V>
HWY_INLINE V at_least(V low, V y) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Max(low, y);  // if one operand is NaN, the instruction returns the second
#else
  return hn::IfThenElse(hn::Lt(y, low), low, y);
#endif
}

/// y limited to [low, high]; NaN stays NaN.
template <class V>
HWY_INLINE V clamped(V y, V low, V high) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Min(high, at_least(low, y));
#else
  y = at_least(low, y);
  return hn::IfThenElse(hn::Gt(y, high), high, y);
#endif
}

/// Offset of vector v within panels that are `panel_stride` apart.
constexpr Index in_panel(int v, Index panel_stride) {
  return v / kVectorsPerPanel * panel_stride + v % kVectorsPerPanel * kLanes;
}

/// How many lanes of vector v lie within the first `columns` columns of a tile.
template <class I>
HWY_INLINE std::size_t lanes_within(I v, Index columns) {
  return static_cast<std::size_t>(HWY_MIN(HWY_MAX(columns - v * kLanes, Index{0}), kLanes));
}

/// Loads or stores the first `count` elements at p, which need not be aligned, and touches nothing after them.
HWY_INLINE PanelVector load_first(std::size_t count, const float* p) {
  const PanelTag d;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  return hn::MaskedLoad(hn::FirstN(d, count), d, p);
#else
  alignas(kAlignment) float lanes[kPanel] = {};
  std::copy_n(p, count, lanes);
  return hn::Load(d, lanes);
#endif
}
HWY_INLINE void store_first(std::size_t count, PanelVector value, float* p) {
  const PanelTag d;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  hn::BlendedStore(value, hn::FirstN(d, count), d, p);
#else
  alignas(kAlignment) float lanes[kPanel];
  hn::Store(value, d, lanes);
  std::copy_n(lanes, count, p);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
