// The product of a few rows and one panel of 16 columns, kept in registers: what every fast convolution ends in.
// Included once per instruction set by the kernels that use it.
#if defined(SVNET_MICRO_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_MICRO_KERNEL_INL_H_
#undef SVNET_MICRO_KERNEL_INL_H_
#else
#define SVNET_MICRO_KERNEL_INL_H_
#endif

#include <array>
#include <utility>

#include <hwy/highway.h>

#include "nn/kernels/packed/panel.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Lanes of one vector: a whole panel where the machine has vectors that wide.
using PanelTag = hn::CappedTag<float, kPanel>;
using PanelVector = hn::Vec<PanelTag>;
inline constexpr int kVectorsPerPanel = static_cast<int>(kPanel / hn::MaxLanes(PanelTag()));

/// Rows whose sums fit the registers beside a panel's row and a broadcast number: 6·2 of 16 vectors for AVX2, 14 of 32
/// for AVX-512, 3·4 of 16 for SSE4, 6·4 of 32 for NEON.
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
inline constexpr int kTileRows = 14;
#elif HWY_ARCH_X86 && HWY_MAX_BYTES == 16
inline constexpr int kTileRows = 3;
#else
inline constexpr int kTileRows = 6;
#endif

/// body(std::integral_constant<int, 0>), … up to count - 1, without a loop: the indices are constants to the compiler.
template <class Body, int... i>
HWY_INLINE void unrolled(Body&& body, std::integer_sequence<int, i...>) {
  (body(std::integral_constant<int, i>{}), ...);
}
template <int kCount, class Body>
HWY_INLINE void unrolled(Body&& body) {
  unrolled(body, std::make_integer_sequence<int, kCount>{});
}

/// The greater of both; a NaN in y stays.
template <class V>
HWY_INLINE V at_least(V low, V y) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Max(low, y);  // of two numbers, one a NaN, the instruction gives the second
#else
  return hn::IfThenElse(hn::Lt(y, low), low, y);
#endif
}

/// y between the bounds; NaN stays NaN.
template <class V>
HWY_INLINE V clamped(V y, V low, V high) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  return hn::Min(high, at_least(low, y));
#else
  y = at_least(low, y);
  return hn::IfThenElse(hn::Gt(y, high), high, y);
#endif
}

/// sum (kRows, 16) += a (kRows, k) · panel (k, 16), in order of k: a row's sums do not depend on its neighbours.
template <int kRows>
HWY_INLINE void multiply_run(Index k, const float* HWY_RESTRICT a, Index row_stride, const float* HWY_RESTRICT panel,
                             PanelVector (&sum)[kRows][kVectorsPerPanel]) {
  const PanelTag d;
  for (Index i = 0; i < k; ++i) {
    PanelVector b[kVectorsPerPanel];
    unrolled<kVectorsPerPanel>(
        [&](auto v) HWY_ATTR { b[v] = hn::Load(d, panel + i * kPanel + v * (kPanel / kVectorsPerPanel)); });
    unrolled<kRows>([&](auto r) HWY_ATTR {
      const auto x = hn::Set(d, a[r * row_stride + i]);
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { sum[r][v] = hn::MulAdd(x, b[v], sum[r][v]); });
    });
  }
}

/// One tile: c (kRows, 16) = finish(a · panel [+ c]).
template <int kRows>
HWY_NOINLINE void multiply_tile(const PanelRows& a, Index k, const float* panel, const TileOutput& out) {
  const PanelTag d;
  constexpr Index kLanes = kPanel / kVectorsPerPanel;
  PanelVector sum[kRows][kVectorsPerPanel];
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
      sum[r][v] = out.accumulate ? hn::LoadU(d, out.c + r * out.stride + v * kLanes) : hn::Zero(d);
    });
  });
  if (a.block_stride == a.run) {
    multiply_run<kRows>(k, a.data, a.row_stride, panel, sum);
  } else {
    const float* block = a.data;
    Index rest = k;
    for (; rest >= a.run; rest -= a.run, block += a.block_stride, panel += a.run * kPanel)
      multiply_run<kRows>(a.run, block, a.row_stride, panel, sum);
    multiply_run<kRows>(rest, block, a.row_stride, panel, sum);
  }
  if (out.finish != nullptr) {
    const TileFinish& finish = *out.finish;
    const auto low = hn::Set(d, finish.low), high = hn::Set(d, finish.high);
    unrolled<kRows>([&](auto r) HWY_ATTR {
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR {
        auto y = hn::Add(sum[r][v], hn::LoadU(d, finish.bias + v * kLanes));
        if (finish.residual != nullptr)
          y = hn::Add(y, hn::LoadU(d, finish.residual + r * finish.residual_stride + v * kLanes));
        sum[r][v] = clamped(y, low, high);
      });
    });
  }
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { hn::StoreU(sum[r][v], d, out.c + r * out.stride + v * kLanes); });
  });
}

using MultiplyTile = void (*)(const PanelRows&, Index, const float*, const TileOutput&);

template <int... rows>
constexpr auto tile_kernels(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_tile<rows + 1>...};
}
inline constexpr auto kTileKernels = tile_kernels(std::make_integer_sequence<int, kTileRows>{});

/// c (rows, 16) = finish(a (rows, k) · panel [+ c]), whatever the number of rows: tiles as equal as can be.
HWY_INLINE void multiply_panel(Index rows, PanelRows a, Index k, const float* panel, TileOutput out) {
  TileFinish finish{};
  if (out.finish != nullptr) finish = *out.finish, out.finish = &finish;
  for (Index tiles = (rows + kTileRows - 1) / kTileRows; tiles > 0; --tiles) {
    const Index height = (rows + tiles - 1) / tiles;
    kTileKernels[static_cast<std::size_t>(height - 1)](a, k, panel, out);
    a.data += height * a.row_stride;
    out.c += height * out.stride;
    if (finish.residual != nullptr) finish.residual += height * finish.residual_stride;
    rows -= height;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
