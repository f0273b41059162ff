// Xception (Chollet, 2017). Input (size, size, 3); the pooled output is `avg_pool` (2048). Keras numbers the layers of
// the four shortcuts as it makes them: conv2d, conv2d_1, … and batch_normalization, batch_normalization_1, ….
#include "models/backbones.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

class Builder {
 public:
  Graph build(Index size, bool top) {
    NodeId x = g_.input("input_1", {size, size, 3});
    x = stem(x, "block1_conv1", 32, 2);
    x = stem(x, "block1_conv2", 64, 1);
    x = down(2, x, {128, 128}, false);
    x = down(3, x, {256, 256}, true);
    x = down(4, x, {728, 728}, true);
    for (int block = 5; block <= 12; ++block) {
      NodeId y = x;
      for (int i = 1; i <= 3; ++i) y = separable(block, i, relu(name(block, "sepconv", i) + "_act", y), 728);
      x = add(y, x);
    }
    x = down(13, x, {728, 1024}, true);
    x = relu("block14_sepconv1_act", separable(14, 1, x, 1536));
    x = relu("block14_sepconv2_act", separable(14, 2, x, 2048));
    x = g_.add("avg_pool", GlobalPool2dLayer{.kind = PoolKind::average}, {x});
    if (top) g_.add("predictions", DenseLayer{.units = 1000, .activation = Activation::softmax}, {x});
    return std::move(g_);
  }

 private:
  static std::string name(int block, const std::string& what, int i) {
    return "block" + std::to_string(block) + "_" + what + std::to_string(i);
  }
  /// Keras' automatic names: "add", "add_1", ….
  static std::string numbered(const std::string& what, int i) { return i == 0 ? what : what + "_" + std::to_string(i); }

  NodeId relu(const std::string& layer, NodeId x) { return activation(g_, layer, x, Activation::relu); }

  NodeId stem(NodeId x, const std::string& layer, Index filters, Index stride) {
    x = conv(g_, layer, x, {.filters = filters, .kernel = 3, .stride = stride, .padding = Padding::valid()});
    return relu(layer + "_act", batch_norm(g_, layer + "_bn", x));
  }

  NodeId separable(int block, int i, NodeId x, Index filters) {
    const std::string layer = name(block, "sepconv", i);
    x = g_.add(layer,
               SeparableConv2dLayer{.filters = filters, .kh = 3, .kw = 3, .padding = Padding::same(), .bias = false},
               {x});
    return batch_norm(g_, layer + "_bn", x);
  }

  NodeId add(NodeId a, NodeId b) { return g_.add(numbered("add", adds_++), AddLayer{}, {a, b}); }

  struct Filters {
    Index first, second;
  };
  /// Two separable convolutions and a pooling beside a shortcut of stride 2.
  NodeId down(int block, NodeId input, Filters filters, bool activated) {
    NodeId shortcut = conv(g_, numbered("conv2d", shortcuts_), input, {.filters = filters.second, .stride = 2});
    shortcut = batch_norm(g_, numbered("batch_normalization", shortcuts_++), shortcut);
    NodeId x = activated ? relu(name(block, "sepconv", 1) + "_act", input) : input;
    x = separable(block, 1, x, filters.first);
    x = separable(block, 2, relu(name(block, "sepconv", 2) + "_act", x), filters.second);
    x = g_.add("block" + std::to_string(block) + "_pool",
               Pool2dLayer{.window = {.kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = Padding::same()}},
               {x});
    return add(x, shortcut);
  }

  Graph g_{};
  int adds_ = 0, shortcuts_ = 0;
};

Graph xception_graph(Index size, bool top) { return Builder().build(size, top); }

}  // namespace

BackboneKind xception() {
  return {.name = "xception",
          .pooled = "avg_pool",
          .last_block_input = "add_11",
          .preprocessing = {.mode = PixelMode::tf, .height = 299, .width = 299},
          .graph = xception_graph,
          .weight_files = {"xception_weights_tf_dim_ordering_tf_kernels_notop.h5",
                           "xception_weights_tf_dim_ordering_tf_kernels.h5"}};
}

}  // namespace svnet::models
