// The product of a few rows and one or two panels of 16 columns, kept in registers: what every fast convolution ends
// in. Included once per instruction set by the kernels that use it.
#if defined(SVNET_MICRO_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_MICRO_KERNEL_INL_H_
#undef SVNET_MICRO_KERNEL_INL_H_
#else
#define SVNET_MICRO_KERNEL_INL_H_
#endif

#include <algorithm>
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

/// Rows and panels whose sums fit the registers beside the panels' row and a broadcast number: 6·2 of 16 vectors for
/// AVX2, 14·2 of 32 for AVX-512 (one panel alone would ask for a load with every product), 3·4 of 16 for SSE4, 6·4 of
/// 32 for NEON.
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
inline constexpr int kTileRows = 14, kTilePanels = 2;
#elif HWY_ARCH_X86 && HWY_MAX_BYTES == 16
inline constexpr int kTileRows = 3, kTilePanels = 1;
#else
inline constexpr int kTileRows = 6, kTilePanels = 1;
#endif
static_assert(kTileRows <= kMostTileRows && kTilePanels <= kMostTilePanels);

/// body(std::integral_constant<int, 0>), … up to count - 1, without a loop: the indices are constants to the compiler.
template <class Body, int... i>
HWY_INLINE void unrolled(Body&& body, std::integer_sequence<int, i...>) {
  (body(std::integral_constant<int, i>{}), ...);
}
template <int kCount, class Body>
HWY_INLINE void unrolled(Body&& body) {
  unrolled(body, std::make_integer_sequence<int, kCount>{});
}

/// Where vector v of some panels lies, which are `panel_stride` apart.
constexpr Index in_panel(int v, Index panel_stride) {
  return v / kVectorsPerPanel * panel_stride + v % kVectorsPerPanel * (kPanel / kVectorsPerPanel);
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

/// sum (kRows, kVectors · lanes) += a (kRows, k) · panels, in order of k: a row's sums do not depend on its neighbours.
/// The panels' rows of 16 lie `panel_stride` apart.
template <int kRows, int kVectors>
HWY_INLINE void multiply_run(Index k, const float* HWY_RESTRICT a, Index row_stride, const float* HWY_RESTRICT panel,
                             Index panel_stride, Index ahead, PanelVector (&sum)[kRows][kVectors]) {
  const PanelTag d;
  for (Index i = 0; i < k; ++i) {
    __builtin_prefetch(panel + i * kPanel + ahead, 0, 2);
    PanelVector b[kVectors];
    unrolled<kVectors>([&](auto v) HWY_ATTR { b[v] = hn::Load(d, panel + i * kPanel + in_panel(v, panel_stride)); });
    unrolled<kRows>([&](auto r) HWY_ATTR {
      const auto x = hn::Set(d, a[r * row_stride + i]);
      unrolled<kVectors>([&](auto v) HWY_ATTR { sum[r][v] = hn::MulAdd(x, b[v], sum[r][v]); });
    });
  }
}

/// How many lanes of vector v lie within the first `columns` columns of a tile.
template <class I>
HWY_INLINE std::size_t lanes_within(I v, Index columns) {
  const Index lanes = kPanel / kVectorsPerPanel;
  return static_cast<std::size_t>(HWY_MIN(HWY_MAX(columns - v * lanes, Index{0}), lanes));
}

/// The first `count` numbers from p, which need not be aligned, and nothing behind them.
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

/// One tile: c (kRows, kPanels · 16) = finish(a · panels [+ c]).
template <int kRows, int kPanels>
HWY_NOINLINE HWY_FLATTEN void multiply_tile(const PanelRows& a, Index k, const float* panel, Index panel_stride,
                                            const TileOutput& out) {
  const PanelTag d;
  constexpr int kVectors = kPanels * kVectorsPerPanel;
  PanelVector sum[kRows][kVectors];
  const auto at = [&](auto r, auto v) HWY_ATTR { return out.c + r * out.stride + in_panel(v, out.panel_stride); };
  const bool is_whole = out.columns >= kPanels * kPanel;
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectors>([&](auto v) HWY_ATTR {
      if (!out.accumulate)
        sum[r][v] = hn::Zero(d);
      else
        sum[r][v] = is_whole ? hn::LoadU(d, at(r, v)) : load_first(lanes_within(v, out.columns), at(r, v));
    });
  });
  if (a.block_stride == a.run) {
    multiply_run(k, a.data, a.row_stride, panel, panel_stride, out.ahead, sum);
  } else {
    const float* block = a.data;
    Index rest = k;
    for (; rest >= a.run; rest -= a.run, block += a.block_stride, panel += a.run * kPanel)
      multiply_run(a.run, block, a.row_stride, panel, panel_stride, out.ahead, sum);
    multiply_run(rest, block, a.row_stride, panel, panel_stride, out.ahead, sum);
  }
  if (out.finish != nullptr) {
    const TileFinish& finish = *out.finish;
    const auto low = hn::Set(d, finish.low), high = hn::Set(d, finish.high);
    unrolled<kRows>([&](auto r) HWY_ATTR {
      unrolled<kVectors>([&](auto v) HWY_ATTR {
        auto y = hn::Add(sum[r][v], hn::LoadU(d, finish.bias + in_panel(v, kPanel)));
        if (finish.residual != nullptr)
          y = hn::Add(y, hn::LoadU(d, finish.residual + r * finish.residual_stride + in_panel(v, kPanel)));
        sum[r][v] = clamped(y, low, high);
      });
    });
  }
  if (is_whole) {
    unrolled<kRows>([&](auto r)
                        HWY_ATTR { unrolled<kVectors>([&](auto v) HWY_ATTR { hn::StoreU(sum[r][v], d, at(r, v)); }); });
  } else {
    unrolled<kRows>([&](auto r) HWY_ATTR {
      unrolled<kVectors>([&](auto v) HWY_ATTR { store_first(lanes_within(v, out.columns), sum[r][v], at(r, v)); });
    });
  }
}

template <int kPanels, int... rows>
constexpr auto tile_kernels(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_tile<rows + 1, kPanels>...};
}
template <int kPanels>
inline constexpr auto kTileKernels = tile_kernels<kPanels>(std::make_integer_sequence<int, kTileRows>{});

/// c (rows, kPanels · 16) = finish(a (rows, k) · panels [+ c]), whatever the number of rows: tiles as equal as can be.
/// `kernels` are those of 1, …, kTileRows rows. fetch_following: the next panels lie panel_stride apart behind these.
template <int kPanels>
HWY_INLINE void multiply_panels_together(Index rows, PanelRows a, Index k, const float* panel, Index panel_stride,
                                         TileOutput out, const MultiplyTile* kernels = kTileKernels<kPanels>.data(),
                                         bool fetch_following = false) {
  TileFinish finish{};
  if (out.finish != nullptr) finish = *out.finish, out.finish = &finish;
  const Index tiles = (rows + kTileRows - 1) / kTileRows;
  for (Index t = 0; t < tiles; ++t) {
    const Index height = (rows + tiles - t - 1) / (tiles - t);
    // The first tiles fetch the panels that follow: read at once they would come slower than they are multiplied.
    out.ahead = fetch_following && t < kPanels ? (kPanels + t) * panel_stride : 0;
    kernels[height - 1](a, k, panel, panel_stride, out);
    a.data += height * a.row_stride;
    out.c += height * out.stride;
    if (finish.residual != nullptr) finish.residual += height * finish.residual_stride;
    rows -= height;
  }
}

/// The same with one panel: c (rows, 16).
HWY_INLINE void multiply_panel(Index rows, const PanelRows& a, Index k, const float* panel, const TileOutput& out) {
  multiply_panels_together<1>(rows, a, k, panel, 0, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
