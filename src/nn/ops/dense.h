#pragma once
#include "nn/tensor.h"

namespace svnet {
class Communicator;
}

namespace svnet::ops {

/// x (M, C) · w (C, K) -> (M, K). The gradient of w goes to the sink as its factors x and dy.
/// With a communicator, each process computes a share of the tiles of y and of the gradient of x, and receives the
/// others; the bits are those of one process. Requires f32, the same x, w and dy in all processes, and that the
/// communicator lives as long as the tape.
Tensor dense(const Tensor& x, const Tensor& w, Communicator* communicator = nullptr);

/// x (…, C) + bias (C).
Tensor bias_add(const Tensor& x, const Tensor& bias);

}  // namespace svnet::ops
