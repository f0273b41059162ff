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

/// The same for an image that is made as it is needed: clamp(x · expansion + bias), x (n, h, w, expansion.k), a few
/// rows at a time that stay in L2. window is the depthwise one, over that image. Every chunk of output rows makes the
/// rows that its windows reach, so that some are made twice; that changes no bits.
void expanded_separable_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& expansion,
                               Clamp clamp, const DepthwiseTaps& depthwise, const PackedWeights& pointwise,
                               const PackedFinish& finish, float* y, float* scratch);
/// k: the expansion's.
Index expanded_separable_scratch(const Window& window, int threads, Index k, Precision precision = Precision::f32);
/// Whether that is faster than the image as a whole: where it is too large for L2, and rows suffice for all threads.
bool expands_by_rows(const Window& window);

}  // namespace svnet::kernels
