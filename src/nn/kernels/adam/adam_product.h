#pragma once
#include "nn/kernels/adam/adam.h"

namespace svnet::kernels {

/// The product xᵀ·dy (C, K) as the gradient of one step of Adam: x (M, C), dy (M, K), and parameter, m, v (C, K).
struct AdamProductShape {
  Index m, c, k;
};

/// The gradient is computed in tiles that stay in cache, and each tile's step follows at once: no gradient of the
/// parameter's size exists, and each weight costs 12 bytes read and 12 written. Sums are in order of M for any number
/// of threads.
void adam_product(Parallel&, const AdamStep&, const AdamProductShape&, const float* x, const float* dy,
                  float* parameter, float* m, float* v);

}  // namespace svnet::kernels
