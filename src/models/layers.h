#pragma once
#include <string>

#include "nn/graph/graph.h"

namespace svnet::models {

// Short forms for the layers that Keras' mobile networks share. Each adds one node and returns it.

struct ConvOptions {
  Index filters, kernel = 1, stride = 1;
  Padding padding = Padding::same();
};

/// Convolution without bias.
inline NodeId conv(Graph& graph, const std::string& name, NodeId x, const ConvOptions& o) {
  return graph.add(name,
                   Conv2dLayer{.filters = o.filters,
                               .kh = o.kernel,
                               .kw = o.kernel,
                               .stride_h = o.stride,
                               .stride_w = o.stride,
                               .padding = o.padding,
                               .bias = false},
                   {x});
}

/// 3×3 depthwise convolution without bias.
inline NodeId depthwise(Graph& graph, const std::string& name, NodeId x, Index stride, const Padding& padding) {
  return graph.add(
      name,
      DepthwiseConv2dLayer{.kh = 3, .kw = 3, .stride_h = stride, .stride_w = stride, .padding = padding, .bias = false},
      {x});
}

inline NodeId batch_norm(Graph& graph, const std::string& name, NodeId x, double momentum = 0.99) {
  return graph.add(name, BatchNormLayer{{.momentum = momentum, .epsilon = 1e-3}}, {x});
}

inline NodeId activation(Graph& graph, const std::string& name, NodeId x, Activation kind) {
  return graph.add(name, ActivationLayer{kind}, {x});
}

}  // namespace svnet::models
