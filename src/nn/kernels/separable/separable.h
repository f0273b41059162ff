#pragma once
#include "base/parallel.h"
#include "nn/kernels/packed/packed_gemm.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// The depthwise half of a separable convolution: taps [KH · KW][C] and bias [C], each row filled up with zeros to
/// whole panels; what comes before (relu(x)) and after it (clamp). Immutable once made.
struct DepthwiseTaps {
  Index channels = 0;
  AlignedFloats taps{}, bias{};
  bool relu_input = false;
  Clamp clamp = Clamp::none;
};

/// From w (KH, KW, C, 1); bias (C) may be nullptr, which means zeros.
DepthwiseTaps depthwise_taps(Index kh, Index kw, Index c, const float* w, const float* bias);

/// y = finish(clamp(depthwise(relu?(x)) + bias) · pointwise + bias): both convolutions over blocks of positions that
/// stay in L2, so that what lies between never goes to memory. x must allow reading one vector past its end. scratch
/// holds separable_scratch numbers.
void separable_conv2d(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                      const PackedWeights& pointwise, const PackedFinish& finish, float* y, float* scratch);
Index separable_scratch(const Window& window, int threads, Precision precision = Precision::f32);

/// The same for the positions [begin, end) of all outputs, on the calling thread. y and the residual are those of
/// position begin; scratch is one thread's.
void separable_positions(const Window& window, const float* x, const DepthwiseTaps& depthwise,
                         const PackedWeights& pointwise, PackedFinish finish, Index begin, Index end, float* y,
                         float* scratch);

}  // namespace svnet::kernels
