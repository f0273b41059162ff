#pragma once
#include "nn/kernels/separable/separable.h"
#include "nn/kernels/separable/strips.h"

namespace svnet::kernels {

/// separable_conv2d of the image clamp(x · expansion + bias), which is computed in strips that stay in L2 and never
/// stored as a whole. x is (N, H, W, expansion.depth); window is the depthwise one, over the image. fits_strips(window)
/// says whether this is faster.
void expanded_separable_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& expansion,
                               Clamp clamp, const DepthwiseTaps& depthwise, const PackedWeights& pointwise,
                               const PackedFinish& finish, float* y, float* scratch);
/// depth is that of the expansion.
Index expanded_separable_scratch(const Window& window, int threads, Index depth, Precision precision = Precision::f32);

/// y = max_pool(separable_conv2d(x)) without a residual, in strips too. pool is the window over the result of the
/// convolution.
void separable_max_pool(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                        const PackedWeights& pointwise, Clamp clamp, const Window& pool, float* y, float* scratch);
Index separable_max_pool_scratch(const Window& window, const Window& pool, int threads,
                                 Precision precision = Precision::f32);

}  // namespace svnet::kernels
