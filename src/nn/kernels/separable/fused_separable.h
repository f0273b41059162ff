#pragma once
#include "nn/kernels/separable/separable.h"
#include "nn/kernels/separable/strips.h"

namespace svnet::kernels {

/// separable_conv2d of an image that is made as it is needed: clamp(x · expansion + bias), x (n, h, w, expansion.k), in
/// strips that stay in L2. window is the depthwise one, over that image; fits_strips(window) says whether that is
/// faster.
void expanded_separable_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& expansion,
                               Clamp clamp, const DepthwiseTaps& depthwise, const PackedWeights& pointwise,
                               const PackedFinish& finish, float* y, float* scratch);
/// k: the expansion's.
Index expanded_separable_scratch(const Window& window, int threads, Index k, Precision precision = Precision::f32);

/// y = max_pool(separable_conv2d(x)), likewise, without a residual. pool is the window over the result of the first.
void separable_max_pool(Parallel& parallel, const Window& window, const float* x, const DepthwiseTaps& depthwise,
                        const PackedWeights& pointwise, Clamp clamp, const Window& pool, float* y, float* scratch);
Index separable_max_pool_scratch(const Window& window, const Window& pool, int threads,
                                 Precision precision = Precision::f32);

}  // namespace svnet::kernels
