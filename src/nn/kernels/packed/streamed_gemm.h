#pragma once
#include "base/index.h"
#include "base/parallel.h"

namespace svnet::kernels {

struct StreamedShape {
  Index m, n, k;
};

/// c (m, n) = a (m, k) · w (k, n), row-major, for few rows and a weight matrix that comes from memory: w is read once,
/// in blocks that are laid out in cache while the next one is asked for. Sums in order of k, for any number of threads.
void streamed_gemm(Parallel& parallel, const StreamedShape& shape, const float* a, const float* w, float* c);

}  // namespace svnet::kernels
