#pragma once
#include "base/parallel.h"
#include "nn/kernels/packed/packed_gemm.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// y (N, OH, OW, K) = finish(x * weights): the weights are those of (KH · KW · C, K). Windows are read where they lie
/// if rows of output are long, as in first layers, or they are 1×1 of stride 1; otherwise they are gathered block by
/// block, never whole. scratch holds packed_conv2d_scratch numbers.
void packed_conv2d(Parallel& parallel, const Window& window, const float* x, const PackedWeights& weights,
                   const PackedFinish& finish, float* y, float* scratch);
/// Numbers of scratch memory for `threads` threads; 0 where none is needed.
Index packed_conv2d_scratch(const Window& window, int threads, Precision precision = Precision::f32);

}  // namespace svnet::kernels
