// dw = Gᵀ (Σ over tiles of (Bᵀ x B) ⊙ (A dy Aᵀ)) G: the transpose of the forward. Groups of tiles are transformed, then
// each panel of output channels sums the outer products of its points with all input channels, and turns into taps
// last.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/winograd/weight_gradient.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/winograd/plan.h"
#include "nn/kernels/winograd/transforms-inl.h"
#include "nn/kernels/winograd/winograd.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// The points of the output gradients of tiles [begin, end) among those of the group [first, last): [k /
/// 16][36][tile][16].
void transform_gradients(const WinogradPlan& plan, const float* dy, Index first, Index last, Index begin, Index end,
                         float* points) {
  const PanelTag d;
  const Window& w = plan.window;
  for (Index tile = begin; tile < end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index rows = HWY_MIN(Index{4}, w.oh - 4 * t.row), columns = HWY_MIN(Index{4}, w.ow - 4 * t.column);
    const float* from = dy + ((t.image * w.oh + 4 * t.row) * w.ow + 4 * t.column) * plan.k;
    for (Index c = 0; c < plan.k; c += kLanes) {
      V y[4][4];
      for (Index i = 0; i < 4; ++i)
        for (Index j = 0; j < 4; ++j)
          y[i][j] = i < rows && j < columns ? hn::LoadU(d, from + (i * w.ow + j) * plan.k + c) : hn::Zero(d);
      transform_gradient_vector(
          y, points + c / kPanel * plan.input_group(last - first) + (tile - first) * kPanel + c % kPanel,
          plan.input_point(last - first));
    }
  }
}

/// sums (kRows, 16) += aᵀ · b: a (tiles, 16) from its first wanted column on, b (tiles, 16).
template <int kRows>
HWY_NOINLINE void outer_tile(Index tiles, const float* HWY_RESTRICT a, const float* HWY_RESTRICT b, bool accumulate,
                             float* HWY_RESTRICT sums) {
  const PanelTag d;
  V sum[kRows][kVectorsPerPanel];
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectorsPerPanel>(
        [&](auto v) HWY_ATTR { sum[r][v] = accumulate ? hn::Load(d, sums + r * kPanel + v * kLanes) : hn::Zero(d); });
  });
  for (Index i = 0; i < tiles; ++i) {
    V y[kVectorsPerPanel];
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { y[v] = hn::Load(d, b + i * kPanel + v * kLanes); });
    unrolled<kRows>([&](auto r) HWY_ATTR {
      const auto x = hn::Set(d, a[i * kPanel + r]);
      unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { sum[r][v] = hn::MulAdd(x, y[v], sum[r][v]); });
    });
  }
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectorsPerPanel>([&](auto v) HWY_ATTR { hn::Store(sum[r][v], d, sums + r * kPanel + v * kLanes); });
  });
}

/// The sixteen channels of a panel in tiles of registers.
HWY_INLINE void outer_panel(Index tiles, const float* a, const float* b, bool accumulate, float* sums) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  outer_tile<8>(tiles, a, b, accumulate, sums);
  outer_tile<8>(tiles, a + 8, b, accumulate, sums + 8 * kPanel);
#elif HWY_ARCH_X86 && HWY_MAX_BYTES == 16
  for (Index r = 0; r < kPanel; r += 2) outer_tile<2>(tiles, a + r, b, accumulate, sums + r * kPanel);
#else
  outer_tile<6>(tiles, a, b, accumulate, sums);
  outer_tile<5>(tiles, a + 6, b, accumulate, sums + 6 * kPanel);
  outer_tile<5>(tiles, a + 11, b, accumulate, sums + 11 * kPanel);
#endif
}

/// One panel of output channels: sums [36][C][16] over a group of tiles.
void sum_points(const WinogradPlan& plan, Index tiles, const float* x, const float* dy, bool accumulate, float* sums) {
  const Index c = plan.window.c;
  for (Index p = 0; p < 36; ++p)
    for (Index g = 0; g < c / kPanel; ++g)
      outer_panel(tiles, x + g * plan.input_group(tiles) + p * plan.input_point(tiles),
                  dy + p * plan.input_point(tiles), accumulate, sums + (p * c + g * kPanel) * kPanel);
}

/// The taps of one panel of output channels.
void transform_taps(const WinogradPlan& plan, const float* sums, Index panel, float* dw) {
  const Index c = plan.window.c;
  for (Index i = 0; i < c; ++i)
    for (Index v = 0; v < kPanel; v += kLanes)
      transform_tap_vector(sums + i * kPanel + v, c * kPanel, dw + i * plan.k + panel * kPanel + v, c * plan.k);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(transform_gradients);
HWY_EXPORT(sum_points);
HWY_EXPORT(transform_taps);

WinogradWeights winograd_flipped_weights(Index c, Index k, const float* w) {
  const AlignedFloats flipped = aligned_floats(9 * c * k);
  for (Index tap = 0; tap < 9; ++tap)
    for (Index i = 0; i < k; ++i)
      for (Index j = 0; j < c; ++j) flipped[((8 - tap) * k + i) * c + j] = w[(tap * c + j) * k + i];
  return winograd_weights(k, c, flipped.get(), nullptr);
}

Index winograd_weight_gradient_scratch(const Window& w, Index k) {
  const WinogradPlan plan(w, k, WinogradPlan::Use::weight_gradient);
  return (w.c + k) / kPanel * plan.input_group(plan.block) + 36 * w.c * k;
}

void winograd_weight_gradient(Parallel& parallel, const Window& w, Index k, const float* x, const float* dy, float* dw,
                              float* scratch) {
  const WinogradPlan plan(w, k, WinogradPlan::Use::weight_gradient);
  const Index c = w.c, panel_sums = 36 * c * kPanel;
  float *x_points = scratch + 36 * c * k, *dy_points = x_points + c / kPanel * plan.input_group(plan.block);
  for (Index first = 0; first < plan.tiles(); first += plan.block) {
    const Index last = std::min(first + plan.block, plan.tiles()), count = last - first;
    parallel.for_chunks(count, 4, [&](Index begin, Index end, int) {
      winograd_input_points(plan, x, first, last, first + begin, first + end, x_points);
      HWY_DYNAMIC_DISPATCH(transform_gradients)(plan, dy, first, last, first + begin, first + end, dy_points);
    });
    parallel.for_chunks(k / kPanel, 1, [&](Index panel, Index, int) {
      HWY_DYNAMIC_DISPATCH(sum_points)
      (plan, count, x_points, dy_points + panel * plan.input_group(count), first > 0, scratch + panel * panel_sums);
    });
  }
  parallel.for_chunks(k / kPanel, 1, [&](Index panel, Index, int) {
    HWY_DYNAMIC_DISPATCH(transform_taps)(plan, scratch + panel * panel_sums, panel, dw);
  });
}

}  // namespace svnet::kernels
#endif
