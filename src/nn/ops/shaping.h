#pragma once
#include <vector>

#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// The same elements under another shape. Throws Error if the number of elements differs.
Tensor reshape(const Tensor& x, Shape shape);
/// (N, …) -> (N, product of the rest), in row-major order: Keras' Flatten.
Tensor flatten(const Tensor& x);
/// x (N, H, W, C) with a border of zeros. Throws Error unless the padding is explicit.
Tensor zero_padding2d(const Tensor& x, const Padding& padding);
/// Elementwise sum. Requires at least one input; throws Error if shapes differ.
Tensor add(const std::vector<Tensor>& inputs);
/// Joins the inputs along the last axis. Requires at least one; throws Error if other sizes differ.
Tensor concat(const std::vector<Tensor>& inputs);

}  // namespace svnet::ops
