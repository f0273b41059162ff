#pragma once
#include "nn/kernels/activation/activation.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// A depthwise convolution, then a pointwise one: (H, W, C) -> (OH, OW, filters). depthwise_kernel
/// (KH, KW, C, multiplier), pointwise_kernel (1, 1, C·multiplier, filters), bias (filters).
struct SeparableConv2dLayer {
  Index filters = 1, kh = 1, kw = 1, stride_h = 1, stride_w = 1, multiplier = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;

  static constexpr const char* kFoldingKernel = "pointwise_kernel";

  const char* keras_name() const { return "SeparableConv2D"; }
  std::vector<ParameterSpec> parameters(const Shapes& inputs) const {
    const Index channels = channels_of(inputs);
    std::vector<ParameterSpec> specs{{"depthwise_kernel", {kh, kw, channels, multiplier}, initializer},
                                     {"pointwise_kernel", {1, 1, channels * multiplier, filters}, initializer}};
    add_bias(specs, bias, filters);
    return specs;
  }
  Shape output_shape(const Shapes& inputs) const {
    return window_output(keras_name(), inputs, window_of(*this), filters);
  }
  static void visit(auto& layer, auto&& field) {
    field("filters", layer.filters);
    field("multiplier", layer.multiplier);
    visit_window(layer, field);
    field("bias", layer.bias);
    field("activation", layer.activation);
  }
};

}  // namespace svnet
