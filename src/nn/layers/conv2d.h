#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (H, W, C) -> (OH, OW, filters). kernel (KH, KW, C, filters), bias (filters).
struct Conv2dLayer {
  Index filters = 1, kh = 1, kw = 1, stride_h = 1, stride_w = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;

  static constexpr const char* kFoldingKernel = "kernel";

  const char* keras_name() const { return "Conv2D"; }
  std::vector<ParameterSpec> parameters(const Shapes& inputs) const {
    std::vector<ParameterSpec> specs{{"kernel", {kh, kw, channels_of(inputs), filters}, initializer}};
    add_bias(specs, bias, filters);
    return specs;
  }
  Shape output_shape(const Shapes& inputs) const {
    return window_output(keras_name(), inputs, window_of(*this), filters);
  }
  static void visit(auto& layer, auto&& field) {
    field("filters", layer.filters);
    visit_window(layer, field);
    field("bias", layer.bias);
    field("activation", layer.activation);
  }
};

}  // namespace svnet
