#pragma once
#include <cmath>

#include "frame/top_frame.h"
#include "io/models/model_file.h"
#include "models/backbone.h"
#include "models/pose_head.h"

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

/// A model in the frame `axis` whose weights are made up: every input counts.
inline svnet::Model small_axis_model(svnet::frame::DepthChoice depth = svnet::frame::DepthChoice::none) {
  using namespace svnet;
  const Index inputs = frame::pose_input_count(frame::input_options(depth));
  Model model;
  model.frame = frame::FrameChoice::axis;
  model.depth = depth;
  model.head = models::linear_head(inputs);
  Tensor kernel = Tensor::empty({inputs, 1});
  for (Index i = 0; i < inputs; ++i) kernel.data<float>()[i] = std::sin(1.7f * static_cast<float>(i + 1));
  model.head_parameters.set("ridge/kernel", kernel);
  model.head_parameters.set("ridge/bias", Tensor::full({1}, 0.25f));
  model.input_fingerprint = "small axis";
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
