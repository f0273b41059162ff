#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (H, W, C) -> (OH, OW, C·multiplier). depthwise_kernel (KH, KW, C, multiplier), bias (C·multiplier).
struct DepthwiseConv2dLayer {
  Index kh = 1, kw = 1, stride_h = 1, stride_w = 1, multiplier = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;

  static constexpr const char* kFoldingKernel = "depthwise_kernel";

  const char* keras_name() const { return "DepthwiseConv2D"; }
  std::vector<ParameterSpec> parameters(const Shapes& inputs) const {
    const Index channels = channels_of(inputs);
    std::vector<ParameterSpec> specs{{"depthwise_kernel", {kh, kw, channels, multiplier}, initializer}};
    add_bias(specs, bias, channels * multiplier);
    return specs;
  }
  Shape output_shape(const Shapes& inputs) const {
    return window_output(keras_name(), inputs, window_of(*this), channels_of(inputs) * multiplier);
  }
  static void visit(auto& layer, auto&& field) {
    field("multiplier", layer.multiplier);
    visit_window(layer, field);
    field("bias", layer.bias);
    field("activation", layer.activation);
  }
};

}  // namespace svnet
