// MobileNet (Howard et al., 2017), width 1. Input (size, size, 3), at least 32; the pooled output is
// `global_average_pooling2d` (1024). The top gives the 1000 classes of ImageNet as `predictions`.
#include "models/backbones.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

/// 3×3 depthwise convolution, batch norm, ReLU6, 1×1 convolution, batch norm, ReLU6.
NodeId separable_block(Graph& g, NodeId x, int number, Index filters, Index stride) {
  const std::string id = std::to_string(number);
  if (stride == 2) x = g.add("conv_pad_" + id, ZeroPadding2dLayer{Padding::of(0, 1, 0, 1)}, {x});
  x = depthwise(g, "conv_dw_" + id, x, stride, stride == 1 ? Padding::same() : Padding::valid());
  x = batch_norm(g, "conv_dw_" + id + "_bn", x);
  x = activation(g, "conv_dw_" + id + "_relu", x, Activation::relu6);
  x = conv(g, "conv_pw_" + id, x, {.filters = filters});
  x = batch_norm(g, "conv_pw_" + id + "_bn", x);
  return activation(g, "conv_pw_" + id + "_relu", x, Activation::relu6);
}

Graph mobilenet_graph(Index size, bool top) {
  Graph g;
  NodeId x = g.input("input_1", {size, size, 3});
  x = conv(g, "conv1", x, {.filters = 32, .kernel = 3, .stride = 2});
  x = batch_norm(g, "conv1_bn", x);
  x = activation(g, "conv1_relu", x, Activation::relu6);
  constexpr struct {
    Index filters, stride;
  } kBlocks[] = {{64, 1},  {128, 2}, {128, 1}, {256, 2}, {256, 1},  {512, 2}, {512, 1},
                 {512, 1}, {512, 1}, {512, 1}, {512, 1}, {1024, 2}, {1024, 1}};
  int number = 0;
  for (const auto& block : kBlocks) x = separable_block(g, x, ++number, block.filters, block.stride);
  x = g.add("global_average_pooling2d", GlobalPool2dLayer{.kind = PoolKind::average, .keep_dimensions = top}, {x});
  if (!top) return g;
  x = g.add("dropout", DropoutLayer{1e-3}, {x});
  x = g.add("conv_preds", Conv2dLayer{.filters = 1000, .padding = Padding::same()}, {x});
  x = g.add("reshape_2", ReshapeLayer{{1000}}, {x});
  activation(g, "predictions", x, Activation::softmax);
  return g;
}

}  // namespace

BackboneKind mobilenet() {
  return {.name = "mobilenet",
          .pooled = "global_average_pooling2d",
          .last_block_input = "conv_pw_12_relu",
          .preprocessing = {.mode = PixelMode::tf, .height = 224, .width = 224},
          .graph = mobilenet_graph,
          .weight_files = {"mobilenet_1_0_224_tf_no_top.h5", "mobilenet_1_0_224_tf.h5"}};
}

}  // namespace svnet::models
