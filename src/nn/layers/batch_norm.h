#pragma once
#include "nn/batch_norm_options.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (…, C) -> (…, C). gamma, beta, moving_mean, moving_variance (C).
struct BatchNormLayer {
  BatchNormOptions options{};

  const char* keras_name() const { return "BatchNormalization"; }
  std::vector<ParameterSpec> parameters(const Shapes& inputs) const {
    const Index channels = channels_of(inputs);
    return {{"gamma", {channels}, Initializer::ones},
            {"beta", {channels}, Initializer::zeros},
            {"moving_mean", {channels}, Initializer::zeros, false},
            {"moving_variance", {channels}, Initializer::ones, false}};
  }
  Shape output_shape(const Shapes& inputs) const { return only_input(keras_name(), inputs); }
  static void visit(auto& layer, auto&& field) {
    field("momentum", layer.options.momentum);
    field("epsilon", layer.options.epsilon);
    field("convention", layer.options.convention);
  }
};

}  // namespace svnet
