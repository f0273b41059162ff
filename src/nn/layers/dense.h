#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (C) -> (units). kernel (C, units), bias (units).
struct DenseLayer {
  Index units = 1;
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;

  static constexpr const char* kFoldingKernel = "kernel";

  const char* keras_name() const { return "Dense"; }
  std::vector<ParameterSpec> parameters(const Shapes& inputs) const {
    std::vector<ParameterSpec> specs{{"kernel", {channels_of(inputs), units}, initializer}};
    add_bias(specs, bias, units);
    return specs;
  }
  Shape output_shape(const Shapes& inputs) const {
    const Shape& input = only_input(keras_name(), inputs);
    check(input.size() == 1, "[Dense] expects features, got ", to_string(input), " (flatten first)");
    return {units};
  }
  static void visit(auto& layer, auto&& field) {
    field("units", layer.units);
    field("bias", layer.bias);
    field("activation", layer.activation);
  }
};

}  // namespace svnet
