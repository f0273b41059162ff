#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// The sum of two inputs or more of one shape.
struct AddLayer {
  const char* keras_name() const { return "Add"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    check(inputs.size() >= 2, "[Add] takes two inputs or more, got ", inputs.size());
    for (const Shape& shape : inputs)
      check(shape == inputs[0], "[Add] shapes differ: ", to_string(inputs[0]), " and ", to_string(shape));
    return inputs[0];
  }
  static void visit(auto&, auto&&) {}
};

}  // namespace svnet
