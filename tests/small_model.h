#pragma once
#include <cmath>

#include "frame/frame_inputs.h"
#include "frame/next_inputs.h"
#include "io/models/model_file.h"
#include "models/backbone.h"
#include "models/pose_head.h"
#include "models/turned_backbone.h"

/// A model with random weights that runs within milliseconds: tiny_xception with a head of width 16.
inline svnet::Model small_model(svnet::models::AngleEncoding angles = svnet::models::AngleEncoding::radians) {
  using namespace svnet;
  using namespace svnet::models;
  const Backbone backbone = random_backbone("tiny_xception", "", 2);
  Model model{.backbone = "tiny_xception",
              .backbone_output = backbone.output_name(),
              .preprocessing = backbone.preprocessing(),
              .backbone_graph = backbone.graph(),
              .backbone_parameters = backbone.parameters(),
              .angles = angles,
              .head = sv_net({.features = backbone.dimension(), .width = 16, .angles = angles}),
              .head_parameters = {},
              .input_fingerprint = "small"};
  model.head_parameters = initial_parameters(model.head, 4);
  return model;
}

/// Weights that are made up: every input counts.
inline svnet::Tensor small_weights(const svnet::Shape& shape, float scale) {
  svnet::Tensor weights = svnet::Tensor::empty(shape);
  for (svnet::Index i = 0; i < weights.size(); ++i)
    weights.data<float>()[i] = scale * std::sin(1.7f * static_cast<float>(i + 1));
  return weights;
}

/// Gives a model the head of its frame.
inline void set_small_head(svnet::Model& model) {
  using namespace svnet;
  const Index inputs = frame::input_count(frame_spec(model));
  model.head = models::linear_head(inputs);
  model.head_parameters.set("ridge/kernel", small_weights({inputs, 1}, 1));
  model.head_parameters.set("ridge/bias", Tensor::full({1}, 0.25f));
}

/// Gives a model in another frame than `camera` a head of the next view.
inline void set_small_next_head(svnet::Model& model) {
  using namespace svnet;
  const Index inputs = frame::next_input_count(frame_spec(model));
  model.next_head = models::linear_head(inputs);
  model.next_parameters.set("ridge/kernel", small_weights({inputs, 1}, 0.5f));
  model.next_parameters.set("ridge/bias", Tensor::full({1}, -0.1f));
}

/// A model in the frame `axis`.
inline svnet::Model small_axis_model(svnet::frame::DepthChoice depth = svnet::frame::DepthChoice::none) {
  svnet::Model model;
  model.frame = svnet::frame::FrameChoice::axis;
  model.depth = depth;
  set_small_head(model);
  model.input_fingerprint = "small axis";
  return model;
}

/// A model in a frame with turns: tiny_xception with random weights, 6 x 6 x 160 values pooled to 3 x 3 and projected
/// to 4.
inline svnet::Model small_turned_model(svnet::frame::FrameChoice frame = svnet::frame::FrameChoice::turned,
                                       svnet::frame::DepthChoice depth = svnet::frame::DepthChoice::none) {
  using namespace svnet;
  const models::Backbone backbone = models::random_backbone("tiny_xception", "block4_act", 2);
  const Graph pooled = models::pooled_graph(backbone.graph());
  Model model;
  model.frame = frame;
  model.depth = depth;
  model.backbone = "tiny_xception";
  model.preprocessing = backbone.preprocessing();
  model.backbone_graph = models::projected_graph(pooled, 4);
  model.backbone_output = "projection";
  model.backbone_parameters = backbone.parameters();
  const Index inputs = element_count(pooled.node(pooled.output()).shape);
  model.backbone_parameters.set("projection/kernel", small_weights({inputs, 4}, 0.2f));
  model.backbone_parameters.set("projection/bias", Tensor::full({4}, 0.5f));
  set_small_head(model);
  model.input_fingerprint = "small turned";
  return model;
}

/// An image without symmetry, of any size.
inline svnet::Image small_image(svnet::Index height = 70, svnet::Index width = 50) {
  svnet::Image image{height, width, {}};
  for (svnet::Index y = 0; y < height; ++y)
    for (svnet::Index x = 0; x < width; ++x)
      for (svnet::Index c = 0; c < 3; ++c)
        image.rgb.push_back(static_cast<std::uint8_t>((y * (3 + c) + x * (7 - c) + c * 40 + x * y / 8) % 256));
  return image;
}
