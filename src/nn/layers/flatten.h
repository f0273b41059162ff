#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// Any shape -> (product of its sizes), in row-major order.
struct FlattenLayer {
  const char* keras_name() const { return "Flatten"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const { return {element_count(only_input(keras_name(), inputs))}; }
  static void visit(auto&, auto&&) {}
};

}  // namespace svnet
