#pragma once
#include "nn/autograd.h"
#include "nn/tensor.h"

namespace svnet::train {

/// Whether every element is finite. An empty handle is finite. Requires f32.
bool is_finite(const Tensor& tensor);

/// Whether every element of the parameter's gradient is finite. A gradient that is kept as two factors is not computed:
/// the factors' largest elements bound it.
bool has_finite_gradient(const autograd::GradientMap& gradients, const Tensor& parameter);

}  // namespace svnet::train
