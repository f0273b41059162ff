// A small network in the manner of Xception (Chollet, 2017): a strided convolution, then blocks of two separable
// convolutions and a strided pooling beside a 1×1 shortcut. About 0.27 million parameters. Input (size, size, 3), at
// least 32; the pooled output is `avg_pool` (256). It has no top.
#include "models/backbones.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

NodeId separable(Graph& g, const std::string& name, NodeId x, Index filters) {
  x = g.add(name,
            SeparableConv2dLayer{.filters = filters,
                                 .kh = 3,
                                 .kw = 3,
                                 .padding = Padding::same(),
                                 .bias = false,
                                 .initializer = Initializer::he_normal},
            {x});
  return batch_norm(g, name + "_bn", x);
}

/// Half the height and width, `filters` channels.
NodeId block(Graph& g, const std::string& name, NodeId input, Index filters) {
  NodeId shortcut = conv(g, name + "_shortcut", input, {.filters = filters, .stride = 2});
  shortcut = batch_norm(g, name + "_shortcut_bn", shortcut);
  NodeId x = separable(g, name + "_sepconv1", input, filters);
  x = activation(g, name + "_sepconv2_act", x, Activation::relu);
  x = separable(g, name + "_sepconv2", x, filters);
  x = g.add(name + "_pool",
            Pool2dLayer{.kind = PoolKind::max,
                        .window = {.kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = Padding::same()}},
            {x});
  x = g.add(name + "_add", AddLayer{}, {shortcut, x});
  return activation(g, name + "_act", x, Activation::relu);
}

Graph tiny_xception_graph(Index size, bool) {
  Graph g;
  NodeId x = g.input("input_1", {size, size, 3});
  x = conv(g, "block1_conv1", x, {.filters = 24, .kernel = 3, .stride = 2});
  x = batch_norm(g, "block1_conv1_bn", x);
  x = activation(g, "block1_conv1_act", x, Activation::relu);
  int number = 1;
  for (Index filters : {48, 96, 160, 256}) x = block(g, "block" + std::to_string(++number), x, filters);
  g.add("avg_pool", GlobalPool2dLayer{.kind = PoolKind::average}, {x});
  return g;
}

}  // namespace

BackboneKind tiny_xception() {
  return {.name = "tiny_xception",
          .pooled = "avg_pool",
          .last_block_input = "block4_act",
          .preprocessing = {.mode = PixelMode::tf, .height = 96, .width = 96},
          .graph = tiny_xception_graph,
          .weight_files = {"tiny_xception.h5"}};
}

}  // namespace svnet::models
