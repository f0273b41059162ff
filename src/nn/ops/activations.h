#pragma once
#include "nn/tensor.h"

namespace svnet::ops {

/// max(x, 0), any shape; the gradient at 0 is 0.
Tensor relu(const Tensor& x);
/// min(max(x, 0), 6), any shape; the gradient at 0 and at 6 is 0.
Tensor relu6(const Tensor& x);
/// 1 / (1 + exp(−x)), any shape.
Tensor sigmoid(const Tensor& x);
/// exp(x) / Σ exp(x) over the last axis, shifted by the largest value so that it never overflows.
Tensor softmax(const Tensor& x);

}  // namespace svnet::ops
