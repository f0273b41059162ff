#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/tensor.h"

namespace svnet::ops {

/// x of any shape under the activation; softmax is taken over the last axis.
Tensor activation(const Tensor& x, Activation activation);

inline Tensor relu(const Tensor& x) { return activation(x, Activation::relu); }
inline Tensor relu6(const Tensor& x) { return activation(x, Activation::relu6); }
inline Tensor sigmoid(const Tensor& x) { return activation(x, Activation::sigmoid); }
inline Tensor softmax(const Tensor& x) { return activation(x, Activation::softmax); }

}  // namespace svnet::ops
