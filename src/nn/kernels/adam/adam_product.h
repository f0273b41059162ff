#pragma once
#include "nn/kernels/adam/adam.h"

namespace svnet::kernels {

/// The product xᵀ·dy (C, K) as the gradient of one step of Adam: x (M, C), dy (M, K), and parameter, m, v (C, K).
struct AdamProductShape {
  Index m, c, k;
};

/// The gradient is made in tiles that stay in cache, each followed at once by its step: per weight, 12 bytes are read
/// and 12 written, and no gradient of the parameter's size exists. The sums are in order of M, for any number of
/// threads.
void adam_product(Parallel&, const AdamStep&, const AdamProductShape&, const float* x, const float* dy,
                  float* parameter, float* m, float* v);

}  // namespace svnet::kernels
