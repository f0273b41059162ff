#pragma once
#include <string>
#include <vector>

#include "nn/gradient_check.h"

namespace svnet::test {

/// One line of the table that drives the gradient checks: what is computed, from which inputs. Inputs are f64; the
/// function takes f32 as well.
struct GradientCase {
  std::string op, what;  // "conv2d", "3x3 kernel, stride 2x3, padding same"
  std::vector<Tensor> inputs;
  Function function;
};

/// Every differentiable operation at odd sizes, inputs off the kinks. Cases of one op are neighbours.
std::vector<GradientCase> gradient_cases();

}  // namespace svnet::test
