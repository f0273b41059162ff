// Two ways through the same four steps (transform the inputs, the weights, multiply, transform the outputs):
// few channels: a task takes a block of tiles through all steps, so that its points stay near L2;
// many channels: the points of a group of tiles are made first, then a task takes a panel of output channels, whose
// weights it transforms run by run, so that they are read from memory once and in a quarter of their size.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/winograd/winograd.cpp"
#include "nn/kernels/winograd/winograd.h"

#include <algorithm>
#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/winograd/plan.h"
#include "nn/kernels/winograd/transforms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// The points of tiles [begin, end) among those of the group [first, last): [c / 16][36][last - first][16].
void transform_inputs(const WinogradPlan& plan, const float* x, Index first, Index last, Index begin, Index end,
                      float* points) {
  const Window& w = plan.window;
  const Index groups = w.c / kPanel, image = w.w * w.c;
  alignas(kAlignment) float border[36 * kPanel];
  for (Index tile = begin; tile < end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index row = 4 * t.row - w.top, column = 4 * t.column - w.left;
    const float* from = x + ((t.image * w.h + row) * w.w + column) * w.c;
    const bool inside = row >= 0 && column >= 0 && row + 6 <= w.h && column + 6 <= w.w;
    for (Index g = 0; g < groups; ++g) {
      float* to = points + g * plan.input_group(last - first) + (tile - first) * kPanel;
      const float* source = from + g * kPanel;
      Index source_row = image, source_column = w.c;
      if (!inside) {
        for (Index i = 0; i < 6; ++i)
          for (Index j = 0; j < 6; ++j) {
            const bool in_image = row + i >= 0 && row + i < w.h && column + j >= 0 && column + j < w.w;
            float* pixel = border + (i * 6 + j) * kPanel;
            if (in_image)
              std::memcpy(pixel, source + i * image + j * w.c, kPanel * sizeof(float));
            else
              std::memset(pixel, 0, kPanel * sizeof(float));
          }
        source = border;
        source_row = 6 * kPanel;
        source_column = kPanel;
      }
      for (Index v = 0; v < kPanel; v += kLanes)
        transform_input_vector(source + v, source_row, source_column, to + v, plan.input_point(last - first));
    }
  }
}

/// The weights of input channels [begin, end) of one panel of taps as points [36][end - begin][16], `point` apart.
void transform_weights(const float* taps, Index begin, Index end, float* points, Index point) {
  for (Index c = begin; c < end; ++c)
    for (Index v = 0; v < kPanel; v += kLanes)
      transform_weight_vector(taps + c * 9 * kPanel + v, kPanel, points + (c - begin) * kPanel + v, point);
}

/// Panels of output channels whose products this machine makes together.
Index panels_together() { return kTilePanels; }

/// Of `panels` panels, products [panel](36, tiles, 16) (+)= points of channels [begin, end) times weights
/// [36][end - begin][16], whose points and panels lie so far apart.
void multiply_points(const WinogradPlan& plan, Index tiles, const float* points, Index begin, Index end,
                     const PanelWeights& weights, Index panels, float* products) {
  for (Index p = 0; p < 36; ++p) {
    const PanelRows a{points + begin / kPanel * plan.input_group(tiles) + p * plan.input_point(tiles), kPanel,
                      plan.input_group(tiles)};
    const float* panel = weights.data + p * weights.point;
    const TileOutput out{products + p * plan.output_point(tiles), kPanel, begin > 0, nullptr, plan.output_size(tiles)};
    if (panels == kTilePanels)
      multiply_panels_together<kTilePanels>(tiles, a, end - begin, panel, weights.panel, out);
    else
      multiply_panel(tiles, a, end - begin, panel, out);
  }
}

/// The outputs of tiles [first, last) in one panel of channels.
void transform_outputs(const WinogradPlan& plan, const float* products, const float* bias, Index first, Index last,
                       Index panel, const WinogradFinish& finish, float* y) {
  const PanelTag d;
  const auto range = range_of(finish.clamp);
  const auto low = hn::Set(d, range.low), high = hn::Set(d, range.high);
  const Window& w = plan.window;
  const Index shrink = finish.pool ? 2 : 1, oh = w.oh / shrink, ow = w.ow / shrink, side = 4 / shrink;
  for (Index tile = first; tile < last; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index rows = HWY_MIN(side, oh - side * t.row), columns = HWY_MIN(side, ow - side * t.column);
    if (rows <= 0 || columns <= 0) continue;
    float* to = y + ((t.image * oh + side * t.row) * ow + side * t.column) * plan.k + panel * kPanel;
    for (Index v = 0; v < kPanel; v += kLanes) {
      V out[4][4];
      transform_output_vector(products + (tile - first) * kPanel + v, plan.output_point(last - first), out);
      const auto shift = hn::Load(d, bias + v);
      for (auto& row : out)
        for (V& value : row) {
          value = hn::Add(value, shift);
          value = hn::IfThenElse(hn::Lt(value, low), low, value);
          value = hn::IfThenElse(hn::Gt(value, high), high, value);
        }
      if (finish.pool)
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) {
            // Of two numbers the greater; NaN wins.
            const auto greater = [](V a, V b) HWY_ATTR {
              return hn::IfThenElse(hn::Lt(a, b), b, hn::IfThenElse(hn::Eq(b, b), a, b));
            };
            out[i][j] = greater(greater(out[2 * i][2 * j], out[2 * i][2 * j + 1]),
                                greater(out[2 * i + 1][2 * j], out[2 * i + 1][2 * j + 1]));
          }
      for (Index i = 0; i < rows; ++i)
        for (Index j = 0; j < columns; ++j) hn::StoreU(out[i][j], d, to + (i * ow + j) * plan.k + v);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(transform_inputs);
HWY_EXPORT(transform_weights);
HWY_EXPORT(panels_together);
HWY_EXPORT(multiply_points);
HWY_EXPORT(transform_outputs);

void winograd_input_points(const WinogradPlan& plan, const float* x, Index first, Index last, Index begin, Index end,
                           float* points) {
  HWY_DYNAMIC_DISPATCH(transform_inputs)(plan, x, first, last, begin, end, points);
}

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
    if (weights.transformed) HWY_DYNAMIC_DISPATCH(transform_weights)(packed, 0, c, to, c * kPanel);
  }
  return weights;
}

Index winograd_scratch(const Window& window, const WinogradWeights& weights, int threads) {
  return WinogradPlan(window, weights).scratch(threads);
}

namespace {

/// The outputs of tiles [first, last) in the panels [panel, end), whose products follow each other.
void transform_panels(const WinogradPlan& plan, const float* products, const WinogradWeights& weights, Index first,
                      Index last, Index panel, Index end, const WinogradFinish& finish, float* y) {
  for (; panel < end; ++panel, products += plan.output_size(last - first)) HWY_DYNAMIC_DISPATCH(transform_outputs)
  (plan, products, weights.bias.get() + panel * kPanel, first, last, panel, finish, y);
}

/// A task is a block of tiles.
void by_tiles(Parallel& parallel, const WinogradPlan& plan, const float* x, const WinogradWeights& weights,
              const WinogradFinish& finish, float* y, float* scratch) {
  const Index per_panel = 36 * weights.c * kPanel, all = plan.k / kPanel;
  const Index together = HWY_DYNAMIC_DISPATCH(panels_together)();
  parallel.for_chunks(plan.tiles(), plan.block, [&](Index first, Index last, int worker) {
    float* points = scratch + worker * plan.worker_scratch();
    float* products = points + plan.input_size(plan.block);
    winograd_input_points(plan, x, first, last, first, last, points);
    for (Index panel = 0; panel < all; panel += together) {
      const Index end = std::min(panel + together, all);
      const PanelWeights transformed{weights.panels.get() + panel * per_panel, weights.c * kPanel, per_panel};
      HWY_DYNAMIC_DISPATCH(multiply_points)
      (plan, last - first, points, 0, weights.c, transformed, end - panel, products);
      transform_panels(plan, products, weights, first, last, panel, end, finish, y);
    }
  });
}

/// A task is a panel of output channels, or as many as are multiplied together.
void by_channels(Parallel& parallel, const WinogradPlan& plan, const float* x, const WinogradWeights& weights,
                 const WinogradFinish& finish, float* y, float* scratch) {
  float* points = scratch + parallel.threads() * plan.worker_scratch();
  const Index together = HWY_DYNAMIC_DISPATCH(panels_together)();
  for (Index first = 0; first < plan.tiles(); first += plan.block) {
    const Index last = std::min(first + plan.block, plan.tiles());
    parallel.for_chunks(last - first, 4, [&](Index begin, Index end, int) {
      winograd_input_points(plan, x, first, last, first + begin, first + end, points);
    });
    parallel.for_chunks(plan.k / kPanel, together, [&](Index panel, Index panel_end, int worker) {
      float* transformed = scratch + worker * plan.worker_scratch();
      float* products = transformed + kMostTilePanels * plan.weight_size();
      for (Index begin = 0; begin < weights.c; begin += plan.run) {
        const Index end = std::min(begin + plan.run, weights.c);
        for (Index p = panel; p < panel_end; ++p) {
          const float* taps = weights.panels.get() + p * 9 * weights.c * kPanel;
          float* to = transformed + (p - panel) * plan.weight_size();
          HWY_DYNAMIC_DISPATCH(transform_weights)(taps, begin, end, to, plan.weight_point());
        }
        HWY_DYNAMIC_DISPATCH(multiply_points)
        (plan, last - first, points, begin, end, {transformed, plan.weight_point(), plan.weight_size()},
         panel_end - panel, products);
      }
      transform_panels(plan, products, weights, first, last, panel, panel_end, finish, y);
    });
  }
}

}  // namespace

void winograd_conv2d(Parallel& parallel, const Window& window, const float* x, const WinogradWeights& weights,
                     const WinogradFinish& finish, float* y, float* scratch) {
  const WinogradPlan plan(window, weights);
  (weights.transformed ? by_tiles : by_channels)(parallel, plan, x, weights, finish, y, scratch);
}

}  // namespace svnet::kernels
#endif
