#pragma once
#include <vector>

#include "nn/tensor.h"

namespace svnet::ops {

/// Mean over all elements of (prediction − target)²; equal shapes. The target receives no gradient. -> one element.
Tensor mean_squared_error(const Tensor& prediction, const Tensor& target);

/// Mean over the rows of −log softmax(logits)[class]; logits (M, K), M class numbers in [0, K). -> one element.
Tensor softmax_cross_entropy(const Tensor& logits, const std::vector<Index>& classes);

}  // namespace svnet::ops
