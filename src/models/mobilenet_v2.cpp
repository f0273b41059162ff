// MobileNetV2 (Sandler et al., 2018), width 1. Input (size, size, 3), at least 32; the pooled output is
// `global_average_pooling2d` (1280). The top gives the 1000 classes of ImageNet as `predictions`.
#include "models/backbones.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

constexpr double kMomentum = 0.999;

/// Expansion (except in block 0), 3×3 depthwise convolution, projection; a shortcut if the shapes are equal.
NodeId inverted_residual(Graph& g, NodeId input, int number, Index expansion, Index filters, Index stride) {
  const std::string prefix = number == 0 ? "expanded_conv_" : "block_" + std::to_string(number) + "_";
  NodeId x = input;
  const Index channels = g.node(input).shape.back();
  if (number > 0) {
    x = conv(g, prefix + "expand", x, {.filters = expansion * channels});
    x = batch_norm(g, prefix + "expand_BN", x, kMomentum);
    x = activation(g, prefix + "expand_relu", x, Activation::relu6);
  }
  if (stride == 2) {
    // Keras' correct_pad for a 3×3 kernel.
    const Index top = g.node(x).shape[0] % 2, left = g.node(x).shape[1] % 2;
    x = g.add(prefix + "pad", ZeroPadding2dLayer{Padding::of(top, 1, left, 1)}, {x});
  }
  x = depthwise(g, prefix + "depthwise", x, stride, stride == 1 ? Padding::same() : Padding::valid());
  x = batch_norm(g, prefix + "depthwise_BN", x, kMomentum);
  x = activation(g, prefix + "depthwise_relu", x, Activation::relu6);
  x = conv(g, prefix + "project", x, {.filters = filters});
  x = batch_norm(g, prefix + "project_BN", x, kMomentum);
  return channels == filters && stride == 1 ? g.add(prefix + "add", AddLayer{}, {input, x}) : x;
}

Graph mobilenet_v2_graph(Index size, bool top) {
  Graph g;
  NodeId x = g.input("input_1", {size, size, 3});
  x = conv(g, "Conv1", x, {.filters = 32, .kernel = 3, .stride = 2});
  x = batch_norm(g, "bn_Conv1", x, kMomentum);
  x = activation(g, "Conv1_relu", x, Activation::relu6);
  constexpr struct {
    Index expansion, filters, stride, count;
  } kStages[] = {{1, 16, 1, 1}, {6, 24, 2, 2},  {6, 32, 2, 3}, {6, 64, 2, 4},
                 {6, 96, 1, 3}, {6, 160, 2, 3}, {6, 320, 1, 1}};
  int number = 0;
  for (const auto& stage : kStages)
    for (Index i = 0; i < stage.count; ++i)
      x = inverted_residual(g, x, number++, stage.expansion, stage.filters, i == 0 ? stage.stride : 1);
  x = conv(g, "Conv_1", x, {.filters = 1280, .padding = Padding::valid()});
  x = batch_norm(g, "Conv_1_bn", x, kMomentum);
  x = activation(g, "out_relu", x, Activation::relu6);
  x = g.add("global_average_pooling2d", GlobalPool2dLayer{.kind = PoolKind::average}, {x});
  if (top) g.add("predictions", DenseLayer{.units = 1000, .activation = Activation::softmax}, {x});
  return g;
}

}  // namespace

BackboneKind mobilenet_v2() {
  return {.name = "mobilenet_v2",
          .pooled = "global_average_pooling2d",
          .last_block_input = "block_15_add",
          .preprocessing = {.mode = PixelMode::tf, .height = 224, .width = 224},
          .graph = mobilenet_v2_graph,
          .weight_files = {"mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224_no_top.h5",
                           "mobilenet_v2_weights_tf_dim_ordering_tf_kernels_1.0_224.h5"}};
}

}  // namespace svnet::models
