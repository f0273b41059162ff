// The register tile that every fast product ends in: a few rows times one or two panels of 16 columns, whose sums stay
// in registers. This is the only file that compiles it, once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/f32_tile.cpp"
#include <array>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel_vector-inl.h"
#include "nn/kernels/packed/tile_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// Rows and panels whose sums fit the registers beside one row of the panels and one broadcast element: 6·2 of 16
/// vectors for AVX2, 14·2 of 32 for AVX-512 (with one panel, each product would need a load), 3·4 of 16 for SSE4, 6·4
/// of 32 for NEON. Without vectors a tile is as small as can be.
#if HWY_TARGET == HWY_SCALAR
inline constexpr int kTileRows = 1, kTilePanels = 1;
#elif HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
inline constexpr int kTileRows = HWY_MIN(14, kMostTileRows), kTilePanels = 2;
#elif HWY_ARCH_X86 && HWY_MAX_BYTES == 16
inline constexpr int kTileRows = 3, kTilePanels = 1;
#else
inline constexpr int kTileRows = HWY_MIN(6, kMostTileRows), kTilePanels = 1;
#endif
static_assert(kTileRows <= kMostTileRows && kTilePanels <= kMostTilePanels);

/// sum (kRows, kVectors · lanes) += a (kRows, depth) · panels, in order of depth: the sums of a row do not depend on
/// the other rows.
template <int kRows, int kVectors>
HWY_INLINE void multiply_run(Index depth, const float* HWY_RESTRICT a, Index row_stride,
                             const float* HWY_RESTRICT panel, Index panel_stride, Index prefetch_distance,
                             PanelVector (&sum)[kRows][kVectors]) {
  const PanelTag d;
  for (Index i = 0; i < depth; ++i) {
    __builtin_prefetch(panel + i * kPanel + prefetch_distance, 0, 2);
    PanelVector b[kVectors];
    unrolled<kVectors>([&](auto v) HWY_ATTR { b[v] = hn::Load(d, panel + i * kPanel + in_panel(v, panel_stride)); });
    unrolled<kRows>([&](auto r) HWY_ATTR {
      const auto x = hn::Set(d, a[r * row_stride + i]);
      unrolled<kVectors>([&](auto v) HWY_ATTR { sum[r][v] = hn::MulAdd(x, b[v], sum[r][v]); });
    });
  }
}

/// A MultiplyTile (panel.h) of kRows rows and kPanels panels. kWhole: it has all columns of its panels.
template <int kRows, int kPanels, bool kAccumulate, bool kWhole>
HWY_INLINE void multiply_tile_as(const PanelRows& a, Index depth, const float* panel, Index panel_stride,
                                 const TileOutput& out) {
  const PanelTag d;
  constexpr int kVectors = kPanels * kVectorsPerPanel;
  PanelVector sum[kRows][kVectors];
  const auto at = [&](auto r, auto v) HWY_ATTR { return out.c + r * out.stride + in_panel(v, out.panel_stride); };
  const auto for_each_vector = [&](const auto& body) HWY_ATTR {
    unrolled<kRows>([&](auto r) HWY_ATTR { unrolled<kVectors>([&](auto v) HWY_ATTR { body(r, v); }); });
  };
  for_each_vector([&](auto r, auto v) HWY_ATTR {
    if constexpr (!kAccumulate)
      sum[r][v] = hn::Zero(d);
    else if constexpr (kWhole)
      sum[r][v] = hn::LoadU(d, at(r, v));
    else
      sum[r][v] = load_first(lanes_within(v, out.columns), at(r, v));
  });
  const Index run = a.block_stride == a.run ? depth : a.run;
  const float* block = a.data;
  for (Index rest = depth; rest > 0; rest -= run, block += a.block_stride, panel += run * kPanel)
    multiply_run(HWY_MIN(run, rest), block, a.row_stride, panel, panel_stride, out.prefetch_distance, sum);
  if (out.finish != nullptr) {
    const TileFinish& finish = *out.finish;
    const auto low = hn::Set(d, finish.low), high = hn::Set(d, finish.high);
    for_each_vector([&](auto r, auto v)
                        HWY_ATTR { sum[r][v] = hn::Add(sum[r][v], hn::LoadU(d, finish.bias + in_panel(v, kPanel))); });
    if (finish.residual != nullptr)
      for_each_vector([&](auto r, auto v) HWY_ATTR {
        sum[r][v] =
            hn::Add(sum[r][v], hn::LoadU(d, finish.residual + r * finish.residual_stride + in_panel(v, kPanel)));
      });
    for_each_vector([&](auto r, auto v) HWY_ATTR { sum[r][v] = clamped(sum[r][v], low, high); });
  }
  for_each_vector([&](auto r, auto v) HWY_ATTR {
    if constexpr (kWhole)
      hn::StoreU(sum[r][v], d, at(r, v));
    else
      store_first(lanes_within(v, out.columns), sum[r][v], at(r, v));
  });
}

template <int kRows, int kPanels>
HWY_NOINLINE HWY_FLATTEN void multiply_tile(const PanelRows& a, Index depth, const float* panel, Index panel_stride,
                                            const TileOutput& out) {
  const bool is_whole = out.columns >= kPanels * kPanel;
  if (!out.accumulate && is_whole)
    multiply_tile_as<kRows, kPanels, false, true>(a, depth, panel, panel_stride, out);
  else if (!out.accumulate)
    multiply_tile_as<kRows, kPanels, false, false>(a, depth, panel, panel_stride, out);
  else if (is_whole)
    multiply_tile_as<kRows, kPanels, true, true>(a, depth, panel, panel_stride, out);
  else
    multiply_tile_as<kRows, kPanels, true, false>(a, depth, panel, panel_stride, out);
}

template <int kPanels, int... rows>
constexpr auto kernels_by_rows(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_tile<rows + 1, kPanels>...};
}
template <int kPanels>
inline constexpr auto kKernels = kernels_by_rows<kPanels>(std::make_integer_sequence<int, kTileRows>{});

TileKernels f32_kernels() { return {kTileRows, kTilePanels, kKernels<1>.data(), kKernels<kTilePanels>.data()}; }

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(f32_kernels);

TileKernels f32_tiles() { return HWY_DYNAMIC_DISPATCH(f32_kernels)(); }

}  // namespace svnet::kernels
#endif
