#pragma once
#include "base/parallel.h"
#include "nn/kernels/packed/packed_gemm.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// y (N, OH, OW, weights.n) = finish(x * weights), where weights is the matrix (KH · KW · C, n). Windows are read in
/// place if output rows are long, as in first layers, or if they are 1×1 of stride 1. Otherwise a block of them is
/// gathered at a time. scratch holds packed_conv2d_scratch floats.
void packed_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& weights,
                   const PackedFinish& finish, float* y, float* scratch);
/// Floats of scratch memory for `threads` threads; may be 0.
Index packed_conv2d_scratch(const Window& window, int threads, Precision precision = Precision::f32);

}  // namespace svnet::kernels
