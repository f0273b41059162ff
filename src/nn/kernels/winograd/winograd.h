#pragma once
#include "base/parallel.h"
#include "nn/kernels/packed/packed_weights.h"
#include "nn/kernels/winograd/transforms.h"

namespace svnet::kernels {

// Winograd's F(4×4, 3×3) (Lavin & Gray, 2015): for each pair of input and output channels, a tile of 4×4 outputs costs
// 36 products instead of 144. C is the number of input channels, K of output channels.

/// Weights of a 3×3 convolution for winograd_conv2d. Immutable after winograd_weights.
struct WinogradWeights {
  Index c = 0, k = 0;
  /// If true, panels holds points [k / 16][36][c][16]. If false, it holds taps [k / 16][c][9][16], a quarter of the
  /// memory, and each run of the convolution transforms them.
  bool transformed = false;
  AlignedFloats panels{}, bias{};
};

/// Whether the window is 3×3 of stride 1 and the numbers of channels C and K are multiples of 16.
bool winograd_fits(const Window& window, Index k);

/// From w (3, 3, C, K) and bias (K), which may be nullptr. Requires C and K to be multiples of 16.
WinogradWeights winograd_weights(Index c, Index k, const float* w, const float* bias);

/// y is (N, OH, OW, K), or (N, OH / 2, OW / 2, K) with finish.pool. scratch holds winograd_scratch floats.
void winograd_conv2d(Parallel& parallel, const Window& window, const float* x, const WinogradWeights& weights,
                     const WinogradFinish& finish, float* y, float* scratch);
Index winograd_scratch(const Window& window, const WinogradWeights& weights, int threads);

/// Weights of the convolution that turns dy into dx over Window::input_gradient: dx (N, H, W, C) = dy * flipped. w is
/// (3, 3, C, K).
WinogradWeights winograd_flipped_weights(Index c, Index k, const float* w);

/// dw (3, 3, C, K) from x and dy (N, OH, OW, K), again with 36 products instead of 144 for each tile and pair of
/// channels. scratch holds winograd_weight_gradient_scratch floats.
void winograd_weight_gradient(Parallel& parallel, const Window& window, Index k, const float* x, const float* dy,
                              float* dw, float* scratch);
Index winograd_weight_gradient_scratch(const Window& window, Index k);

}  // namespace svnet::kernels
