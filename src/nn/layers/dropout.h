#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// Any shape, unchanged. Training sets each element to 0 with probability `rate`; inference changes nothing.
struct DropoutLayer {
  double rate = 0.5;

  const char* keras_name() const { return "Dropout"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    check(rate >= 0 && rate < 1, "[Dropout] rate ", rate, " is outside [0, 1)");
    return only_input(keras_name(), inputs);
  }
  static void visit(auto& layer, auto&& field) { field("rate", layer.rate); }
};

}  // namespace svnet
