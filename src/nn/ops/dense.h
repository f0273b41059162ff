#pragma once
#include "nn/tensor.h"

namespace svnet {
class Communicator;
}

namespace svnet::ops {

/// x (M, C) · w (C, K) -> (M, K). The gradient of w goes to the sink as the product xᵀ·dy.
/// A communicator that holds the same x, w and later dy makes y and the gradient of x together, tile by tile, and each
/// of its processes gets all of them: the same bits as alone. f32 only; it must live as long as the tape.
Tensor dense(const Tensor& x, const Tensor& w, Communicator* communicator = nullptr);

/// x (…, C) + bias (C).
Tensor bias_add(const Tensor& x, const Tensor& bias);

}  // namespace svnet::ops
