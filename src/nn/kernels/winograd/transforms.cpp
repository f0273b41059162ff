// The four transforms of winograd_conv2d and of its weight gradient over tiles and panels of channels.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/winograd/transforms.cpp"
#include "nn/kernels/winograd/transforms.h"

#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/aligned.h"
#include "nn/kernels/winograd/transforms-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

void transform_inputs(const WinogradPlan& plan, const float* x, TileRange group, TileRange tiles, float* points) {
  const Window& w = plan.window;
  const Index groups = w.c / kPanel, image = w.w * w.c;
  alignas(kAlignment) float border[36 * kPanel];
  for (Index tile = tiles.begin; tile < tiles.end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index row = 4 * t.row - w.top, column = 4 * t.column - w.left;
    const float* from = x + ((t.image * w.h + row) * w.w + column) * w.c;
    const bool inside = row >= 0 && column >= 0 && row + 6 <= w.h && column + 6 <= w.w;
    for (Index g = 0; g < groups; ++g) {
      float* to = points + g * plan.input_group(group.count()) + (tile - group.begin) * kPanel;
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
        transform_input_vector(source + v, source_row, source_column, to + v, plan.input_point(group.count()));
    }
  }
}

void transform_weights(const float* taps, Index begin, Index end, float* points, Index point) {
  for (Index c = begin; c < end; ++c)
    for (Index v = 0; v < kPanel; v += kLanes)
      transform_weight_vector(taps + c * 9 * kPanel + v, kPanel, points + (c - begin) * kPanel + v, point);
}

void transform_outputs(const WinogradPlan& plan, const float* products, const float* bias, TileRange tiles, Index panel,
                       const WinogradFinish& finish, float* y) {
  const PanelTag d;
  const auto limits = range_of(finish.clamp);
  const auto low = hn::Set(d, limits.low), high = hn::Set(d, limits.high);
  const Window& w = plan.window;
  const Index shrink = finish.pool ? 2 : 1, oh = w.oh / shrink, ow = w.ow / shrink, side = 4 / shrink;
  for (Index tile = tiles.begin; tile < tiles.end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index rows = HWY_MIN(side, oh - side * t.row), columns = HWY_MIN(side, ow - side * t.column);
    if (rows <= 0 || columns <= 0) continue;
    float* to = y + ((t.image * oh + side * t.row) * ow + side * t.column) * plan.k + panel * kPanel;
    for (Index v = 0; v < kPanel; v += kLanes) {
      V out[4][4];
      transform_output_vector(products + (tile - tiles.begin) * kPanel + v, plan.output_point(tiles.count()), out);
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
            // The greater of both; NaN wins.
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

void transform_gradients(const WinogradPlan& plan, const float* dy, TileRange group, TileRange tiles, float* points) {
  const PanelTag d;
  const Window& w = plan.window;
  for (Index tile = tiles.begin; tile < tiles.end; ++tile) {
    const WinogradTile t = plan.tile(tile);
    const Index rows = HWY_MIN(Index{4}, w.oh - 4 * t.row), columns = HWY_MIN(Index{4}, w.ow - 4 * t.column);
    const float* from = dy + ((t.image * w.oh + 4 * t.row) * w.ow + 4 * t.column) * plan.k;
    for (Index c = 0; c < plan.k; c += kLanes) {
      V y[4][4];
      for (Index i = 0; i < 4; ++i)
        for (Index j = 0; j < 4; ++j)
          y[i][j] = i < rows && j < columns ? hn::LoadU(d, from + (i * w.ow + j) * plan.k + c) : hn::Zero(d);
      transform_gradient_vector(
          y, points + c / kPanel * plan.input_group(group.count()) + (tile - group.begin) * kPanel + c % kPanel,
          plan.input_point(group.count()));
    }
  }
}

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

HWY_EXPORT(transform_inputs);
HWY_EXPORT(transform_weights);
HWY_EXPORT(transform_outputs);
HWY_EXPORT(transform_gradients);
HWY_EXPORT(transform_taps);

void winograd_input_points(const WinogradPlan& plan, const float* x, TileRange group, TileRange tiles, float* points) {
  HWY_DYNAMIC_DISPATCH(transform_inputs)(plan, x, group, tiles, points);
}
void winograd_weight_points(const float* taps, Index begin, Index end, float* points, Index point) {
  HWY_DYNAMIC_DISPATCH(transform_weights)(taps, begin, end, points, point);
}
void winograd_outputs(const WinogradPlan& plan, const float* products, const float* bias, TileRange tiles, Index panel,
                      const WinogradFinish& finish, float* y) {
  HWY_DYNAMIC_DISPATCH(transform_outputs)(plan, products, bias, tiles, panel, finish, y);
}
void winograd_gradient_points(const WinogradPlan& plan, const float* dy, TileRange group, TileRange tiles,
                              float* points) {
  HWY_DYNAMIC_DISPATCH(transform_gradients)(plan, dy, group, tiles, points);
}
void winograd_taps(const WinogradPlan& plan, const float* sums, Index panel, float* dw) {
  HWY_DYNAMIC_DISPATCH(transform_taps)(plan, sums, panel, dw);
}

}  // namespace svnet::kernels
#endif
