#pragma once
#include <vector>

#include "nn/kernels/window.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// The same numbers under another shape.
Tensor reshape(const Tensor& x, Shape shape);
/// (N, …) -> (N, product of the rest), in row-major order: Keras' Flatten.
Tensor flatten(const Tensor& x);
/// x (N, H, W, C) with a border of zeros; the padding must be explicit.
Tensor zero_padding2d(const Tensor& x, const Padding& padding);
/// Elementwise sum of tensors of one shape; at least one.
Tensor add(const std::vector<Tensor>& inputs);
/// Along the last axis; all other sizes equal; at least one.
Tensor concat(const std::vector<Tensor>& inputs);

}  // namespace svnet::ops
