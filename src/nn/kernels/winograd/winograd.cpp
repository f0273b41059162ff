// Two ways through the same four steps: transform the inputs, transform the weights, multiply, transform the outputs.
// Few channels: a task takes a block of tiles through all steps, so that its points stay near L2.
// Many channels: the points of a group of tiles are made first. Then a task takes a panel of output channels and
// transforms its weights run by run: they are read from memory once, as taps, which are a quarter of their points.
#include "nn/kernels/winograd/winograd.h"

#include <algorithm>

#include "nn/kernels/packed/tile_kernels.h"

namespace svnet::kernels {
namespace {

WinogradPlan plan_of(const Window& window, const WinogradWeights& weights) {
  using Use = WinogradPlan::Use;
  return {window, weights.k, weights.transformed ? Use::by_tiles : Use::by_channels};
}

/// Transformed weights [36][channels][16] of some panels of output channels, with the distances between two points and
/// between two panels.
struct PanelWeights {
  const float* data;
  Index point, panel;
};

/// products [panels][36][tiles][16] (+)= points of the input channels [begin, end) · weights. `panels` is 1 or
/// kernels.panels. Adds to the products if begin > 0.
void multiply_points(const TileKernels& kernels, const WinogradPlan& plan, Index tiles, const float* points,
                     Index begin, Index end, const PanelWeights& weights, Index panels, float* products) {
  for (Index p = 0; p < 36; ++p) {
    const PanelRows a{points + begin / kPanel * plan.input_group(tiles) + p * plan.input_point(tiles), kPanel,
                      plan.input_group(tiles)};
    multiply_panels(kernels, panels, tiles, a, end - begin, weights.data + p * weights.point, weights.panel,
                    {.c = products + p * plan.output_point(tiles),
                     .stride = kPanel,
                     .accumulate = begin > 0,
                     .panel_stride = plan.output_size(tiles)});
  }
}

/// The outputs of `tiles` in the panels [panel, end) from their products, one panel after the other.
void transform_panels(const WinogradPlan& plan, const float* products, const WinogradWeights& weights, TileRange tiles,
                      Index panel, Index end, const WinogradFinish& finish, float* y) {
  for (; panel < end; ++panel, products += plan.output_size(tiles.count()))
    winograd_outputs(plan, products, weights.bias.get() + panel * kPanel, tiles, panel, finish, y);
}

/// A task is a block of tiles.
void by_tiles(Parallel& parallel, const WinogradPlan& plan, const float* x, const WinogradWeights& weights,
              const WinogradFinish& finish, float* y, float* scratch) {
  const Index per_panel = 36 * weights.c * kPanel, all = plan.k / kPanel;
  const TileKernels kernels = f32_tiles();
  parallel.for_chunks(plan.tiles(), plan.block, [&](Index first, Index last, int worker) {
    const TileRange tiles{first, last};
    float* points = scratch + worker * plan.worker_scratch();
    float* products = points + plan.input_size(plan.block);
    winograd_input_points(plan, x, tiles, tiles, points);
    for (Index panel = 0; panel < all; panel += kernels.panels) {
      const Index end = std::min(panel + kernels.panels, all);
      const PanelWeights transformed{weights.panels.get() + panel * per_panel, weights.c * kPanel, per_panel};
      multiply_points(kernels, plan, tiles.count(), points, 0, weights.c, transformed, end - panel, products);
      transform_panels(plan, products, weights, tiles, panel, end, finish, y);
    }
  });
}

/// A task is one panel of output channels, or as many as are multiplied together.
void by_channels(Parallel& parallel, const WinogradPlan& plan, const float* x, const WinogradWeights& weights,
                 const WinogradFinish& finish, float* y, float* scratch) {
  float* points = scratch + parallel.threads() * plan.worker_scratch();
  const TileKernels kernels = f32_tiles();
  for (Index first = 0; first < plan.tiles(); first += plan.block) {
    const TileRange group{first, std::min(first + plan.block, plan.tiles())};
    parallel.for_chunks(group.count(), 4, [&](Index begin, Index end, int) {
      winograd_input_points(plan, x, group, {first + begin, first + end}, points);
    });
    parallel.for_chunks(plan.k / kPanel, kernels.panels, [&](Index panel, Index panel_end, int worker) {
      float* transformed = scratch + worker * plan.worker_scratch();
      float* products = transformed + kMostTilePanels * plan.weight_size();
      for (Index begin = 0; begin < weights.c; begin += plan.run) {
        const Index end = std::min(begin + plan.run, weights.c);
        for (Index p = panel; p < panel_end; ++p) {
          const float* taps = weights.panels.get() + p * 9 * weights.c * kPanel;
          float* to = transformed + (p - panel) * plan.weight_size();
          winograd_weight_points(taps, begin, end, to, plan.weight_point());
        }
        multiply_points(kernels, plan, group.count(), points, begin, end,
                        {transformed, plan.weight_point(), plan.weight_size()}, panel_end - panel, products);
      }
      transform_panels(plan, products, weights, group, panel, panel_end, finish, y);
    });
  }
}

}  // namespace

bool winograd_fits(const Window& w, Index k) {
  return w.kh == 3 && w.kw == 3 && w.stride_h == 1 && w.stride_w == 1 && w.c % kPanel == 0 && k % kPanel == 0;
}

WinogradWeights winograd_weights(Index c, Index k, const float* w, const float* bias) {
  WinogradWeights weights{.c = c, .k = k, .transformed = c * k <= kMostTransformed};
  const Index per_panel = c * kPanel * (weights.transformed ? 36 : 9);
  weights.panels = aligned_floats(k / kPanel * per_panel);
  weights.bias = aligned_floats(k);
  std::fill_n(weights.bias.get(), k, 0.0f);
  if (bias != nullptr) std::copy_n(bias, k, weights.bias.get());
  AlignedFloats taps = aligned_floats(c * 9 * kPanel);
  for (Index panel = 0; panel < k / kPanel; ++panel) {
    float* to = weights.panels.get() + panel * per_panel;
    float* packed = weights.transformed ? taps.get() : to;
    for (Index i = 0; i < c; ++i)
      for (Index tap = 0; tap < 9; ++tap)
        std::copy_n(w + (tap * c + i) * k + panel * kPanel, kPanel, packed + (i * 9 + tap) * kPanel);
    if (weights.transformed) winograd_weight_points(packed, 0, c, to, c * kPanel);
  }
  return weights;
}

Index winograd_scratch(const Window& window, const WinogradWeights& weights, int threads) {
  return plan_of(window, weights).scratch(threads);
}

void winograd_conv2d(Parallel& parallel, const Window& window, const float* x, const WinogradWeights& weights,
                     const WinogradFinish& finish, float* y, float* scratch) {
  const WinogradPlan plan = plan_of(window, weights);
  (weights.transformed ? by_tiles : by_channels)(parallel, plan, x, weights, finish, y, scratch);
}

}  // namespace svnet::kernels
