#pragma once
#include "base/parallel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// max_pool and average_pool (pool.h) for inference, vectorised over channels: the same numbers, without the sources
/// that a gradient needs.
void max_pool_inference(Parallel& parallel, const Window& window, const float* x, float* y);
/// Positions [begin, end) of all, on the calling thread; y is that of position 0.
void max_pool_positions(const Window& window, Index begin, Index end, const float* x, float* y);
void average_pool_inference(Parallel& parallel, const Window& window, const float* x, float* y);

}  // namespace svnet::kernels
