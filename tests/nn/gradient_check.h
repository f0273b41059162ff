#pragma once
#include <functional>
#include <string>
#include <vector>

#include "nn/tensor.h"

namespace svnet::test {

using Function = std::function<Tensor(const std::vector<Tensor>& inputs)>;

/// The difference between the tape's gradients and central differences.
struct GradientReport {
  /// The largest over the inputs of max |analytic − numeric| / max |numeric|; infinite if a gradient is missing,
  /// has another shape, is NaN, or is 0 everywhere, so that nothing would be checked.
  double relative_error = 0;
  std::string worst;  // "input 1", and what was wrong with it
};

/// Checks d(Σ y·w)/d(input) for fixed random w, every input and every element, in f64. The function is called many
/// times with changed inputs and must give the same output for the same inputs. Also asks for the gradient of each
/// input alone, which must have the same bits.
GradientReport check_gradients(const Function& function, const std::vector<Tensor>& inputs, double step = 1e-5);

}  // namespace svnet::test
