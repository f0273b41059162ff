#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// Any shape -> `shape`, of as many elements.
struct ReshapeLayer {
  Shape shape{};

  const char* keras_name() const { return "Reshape"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    const Shape& input = only_input(keras_name(), inputs);
    check(element_count(input) == element_count(shape), "[Reshape] cannot reshape ", to_string(input), " to ",
          to_string(shape));
    return shape;
  }
  static void visit(auto& layer, auto&& field) { field("shape", layer.shape); }
};

}  // namespace svnet
