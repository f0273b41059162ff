// dw = Gᵀ (Σ over tiles of (Bᵀ x B) ⊙ (A dy Aᵀ)) G: the transpose of the forward pass. A group of tiles is transformed
// at a time. Then each panel of output channels sums the outer products of its points with all input channels. The sums
// become taps last.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/winograd/weight_gradient.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel_vector-inl.h"
#include "nn/kernels/winograd/plan.h"
#include "nn/kernels/winograd/transforms.h"
#include "nn/kernels/winograd/winograd.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// sums (kRows, 16) (+)= aᵀ · b: a is kRows columns of (tiles, 16), b is (tiles, 16).
template <int kRows>
HWY_NOINLINE void outer_tile(Index tiles, const float* HWY_RESTRICT a, const float* HWY_RESTRICT b, bool accumulate,
                             float* HWY_RESTRICT sums) {
  const PanelTag d;
  PanelVector sum[kRows][kVectorsPerPanel];
  unrolled<kRows>([&](auto r) HWY_ATTR {
    unrolled<kVectorsPerPanel>(
        [&](auto v) HWY_ATTR { sum[r][v] = accumulate ? hn::Load(d, sums + r * kPanel + v * kLanes) : hn::Zero(d); });
  });
  for (Index i = 0; i < tiles; ++i) {
    PanelVector y[kVectorsPerPanel];
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

/// All 16 rows, in tiles of registers.
HWY_INLINE void outer_panel(Index tiles, const float* a, const float* b, bool accumulate, float* sums) {
#if HWY_TARGET == HWY_SCALAR
  for (Index r = 0; r < kPanel; ++r) outer_tile<1>(tiles, a + r, b, accumulate, sums + r * kPanel);
#elif HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
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

/// sums [36][C][16] (+)= Σ over a group of tiles of x points times dy points, for one panel of output channels.
void sum_points(const WinogradPlan& plan, Index tiles, const float* x, const float* dy, bool accumulate, float* sums) {
  const Index c = plan.window.c;
  for (Index p = 0; p < 36; ++p)
    for (Index g = 0; g < c / kPanel; ++g)
      outer_panel(tiles, x + g * plan.input_group(tiles) + p * plan.input_point(tiles),
                  dy + p * plan.input_point(tiles), accumulate, sums + (p * c + g * kPanel) * kPanel);
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(sum_points);

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
    const TileRange group{first, std::min(first + plan.block, plan.tiles())};
    parallel.for_chunks(group.count(), 4, [&](Index begin, Index end, int) {
      const TileRange part{first + begin, first + end};
      winograd_input_points(plan, x, group, part, x_points);
      winograd_gradient_points(plan, dy, group, part, dy_points);
    });
    parallel.for_chunks(k / kPanel, 1, [&](Index panel, Index, int) {
      HWY_DYNAMIC_DISPATCH(sum_points)
      (plan, group.count(), x_points, dy_points + panel * plan.input_group(group.count()), first > 0,
       scratch + panel * panel_sums);
    });
  }
  parallel.for_chunks(k / kPanel, 1,
                      [&](Index panel, Index, int) { winograd_taps(plan, scratch + panel * panel_sums, panel, dw); });
}

}  // namespace svnet::kernels
#endif
