#pragma once
#include <string>
#include <vector>

#include "nn/gradient_check.h"

namespace svnet::test {

/// A row of the table of gradient checks: a function and its inputs. Inputs are f64; the
/// function accepts f32 too.
struct GradientCase {
  std::string op, what;  // "conv2d", "3x3 kernel, stride 2x3, padding same"
  std::vector<Tensor> inputs;
  Function function;
};

/// Every differentiable operation at odd sizes, inputs off the kinks. Cases of one op are neighbours.
std::vector<GradientCase> gradient_cases();

}  // namespace svnet::test
