#pragma once
#include "nn/autograd.h"
#include "nn/tensor.h"

namespace svnet {

/// Whether every number is finite; of no tensor, yes. f32.
bool is_finite(const Tensor& tensor);

/// Whether every number of the parameter's gradient is finite. A product is known to be so by a bound, without being
/// formed.
bool has_finite_gradient(const autograd::GradientMap& gradients, const Tensor& parameter);

}  // namespace svnet
