#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// Any shape, unchanged.
struct ActivationLayer {
  Activation activation = Activation::relu;

  const char* keras_name() const { return "Activation"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const { return only_input(keras_name(), inputs); }
  static void visit(auto& layer, auto&& field) { field("activation", layer.activation); }
};

}  // namespace svnet
