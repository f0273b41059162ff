#pragma once
#include <vector>

#include "nn/tensor.h"

namespace svnet::ops {

/// Mean over all elements of (prediction − target)²; -> a scalar. Requires equal shapes. The target
/// receives no gradient.
Tensor mean_squared_error(const Tensor& prediction, const Tensor& target);

/// Mean over the rows of −log softmax(logits)[class]; -> a scalar. logits (M, K), M classes in
/// [0, K); throws Error for a class outside.
Tensor softmax_cross_entropy(const Tensor& logits, const std::vector<Index>& classes);

}  // namespace svnet::ops
