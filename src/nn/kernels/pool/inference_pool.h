#pragma once
#include "base/parallel.h"
#include "nn/kernels/window.h"

namespace svnet::kernels {

/// max_pool and average_pool (pool.h) for inference: the same results without the sources that a gradient needs,
/// vectorised over channels.
void max_pool_inference(Parallel& parallel, const Window& window, const float* x, float* y);
/// The output positions [begin, end), on the calling thread. y points at position 0.
void max_pool_positions(const Window& window, Index begin, Index end, const float* x, float* y);
void average_pool_inference(Parallel& parallel, const Window& window, const float* x, float* y);

}  // namespace svnet::kernels
