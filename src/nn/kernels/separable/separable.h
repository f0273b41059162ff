#pragma once
#include "base/parallel.h"
#include "nn/kernels/packed/packed_gemm.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// The depthwise half of a separable convolution: taps [KH · KW][C] and bias [C], each row filled up with zeros to
/// whole panels. Immutable after depthwise_taps.
struct DepthwiseTaps {
  Index channels = 0, count = 0;  ///< count: KH · KW
  AlignedFloats taps{}, bias{};
  bool relu_input = false;    ///< applied to x before the convolution
  Clamp clamp = Clamp::none;  ///< applied to its result
};

/// From w (KH, KW, C, 1); bias (C) may be nullptr, which means zeros.
DepthwiseTaps depthwise_taps(Index kh, Index kw, Index c, const float* w, const float* bias);

/// Makes the results of the taps those that `input` rounds to bytes, for a pointwise half in int8. The limits of bytes
/// then take the place of the clamp, so the input must be within it.
void round_taps(const ByteInput& input, DepthwiseTaps& taps);

/// The depthwise half alone, of the output positions [begin, end), on the calling thread: y [C / 16][end - begin][16] =
/// clamp(depthwise(relu?(x)) + bias).
void depthwise_rows(const Window& window, const DepthwiseTaps& taps, const float* x, Index begin, Index end, float* y);

/// y = finish(clamp(depthwise(relu?(x)) + bias) · pointwise + bias). Both convolutions run over blocks of positions
/// that stay in L2, so the intermediate image is never written to memory. Requires that x may be read one vector past
/// its end; if the pointwise half is in int8, that round_taps was called with its input. scratch holds
/// separable_scratch floats.
void separable_conv2d(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                      const PackedWeights& pointwise, const PackedFinish& finish, float* y, float* scratch);
Index separable_scratch(const Window& window, int threads, Precision precision = Precision::f32);

/// The same for the output positions [begin, end), on the calling thread. y and the residual point at position begin;
/// scratch is that of one thread.
void separable_positions(const Window& window, const float* x, const DepthwiseTaps& depthwise,
                         const PackedWeights& pointwise, PackedFinish finish, Index begin, Index end, float* y,
                         float* scratch);

}  // namespace svnet::kernels
