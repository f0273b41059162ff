#pragma once
#include "nn/tensor.h"

namespace svnet::ops {

/// Elementwise a · b: Keras' Multiply. One of them may hold a factor per sample and channel: (N, 1, 1, C) or (N, C), if
/// the other is (N, H, W, C). The result has the shape of the larger one.
Tensor multiply(const Tensor& a, const Tensor& b);

}  // namespace svnet::ops
