#pragma once
#include "nn/kernels/epilogue.h"
#include "nn/kernels/winograd/plan.h"

// The transforms of Winograd's F(4×4, 3×3) and of its weight gradient, on the calling thread. 36 points stand for one
// tile; a panel is 16 channels.
namespace svnet::kernels {

/// points [C / 16][36][group.count()][16] of the inputs x (N, H, W, C): writes those of `tiles`, a part of the group.
void winograd_input_points(const WinogradPlan& plan, const float* x, TileRange group, TileRange tiles, float* points);

/// points [36][end - begin][16] of one panel of taps [C][9][16], for the input channels [begin, end). `point` is the
/// distance between two points.
void winograd_weight_points(const float* taps, Index begin, Index end, float* points, Index point);

/// What winograd_outputs does to the outputs: y = clamp(y + bias), then, with `pool`, the maximum of every 2×2.
struct WinogradFinish {
  Clamp clamp = Clamp::none;
  bool pool = false;
};

/// The outputs y of `tiles` in one panel of output channels, from products [36][tiles.count()][16].
void winograd_outputs(const WinogradPlan& plan, const float* products, const float* bias, TileRange tiles, Index panel,
                      const WinogradFinish& finish, float* y);

/// points [K / 16][36][group.count()][16] of the output gradients dy (N, OH, OW, K): writes those of `tiles`, a part of
/// the group.
void winograd_gradient_points(const WinogradPlan& plan, const float* dy, TileRange group, TileRange tiles,
                              float* points);

/// The taps of one panel of output channels in dw (3, 3, C, K), from sums [36][C][16].
void winograd_taps(const WinogradPlan& plan, const float* sums, Index panel, float* dw);

}  // namespace svnet::kernels
