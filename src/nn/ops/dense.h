#pragma once
#include "nn/tensor.h"

namespace svnet::ops {

/// x (M, C) · w (C, K) -> (M, K). The gradient of w goes to the sink as the product xᵀ·dy.
Tensor dense(const Tensor& x, const Tensor& w);

/// x (…, C) + bias (C).
Tensor bias_add(const Tensor& x, const Tensor& bias);

}  // namespace svnet::ops
