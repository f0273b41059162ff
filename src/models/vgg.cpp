// VGG16 and VGG19 (Simonyan & Zisserman, 2015). Input (size, size, 3); the features are `block5_pool`. The top
// (flatten, fc1, fc2, predictions) exists only for the size of its weights, 224.
#include "models/backbones.h"
#include "models/layers.h"

namespace svnet::models {
namespace {

/// `depth`: number of convolutions in each of the last three blocks.
Graph vgg(Index size, bool top, int depth) {
  Graph g;
  NodeId x = g.input("input_1", {size, size, 3});
  constexpr Index kFilters[] = {64, 128, 256, 512, 512};
  for (int block = 1; block <= 5; ++block) {
    const std::string prefix = "block" + std::to_string(block) + "_";
    for (int conv = 1; conv <= (block <= 2 ? 2 : depth); ++conv)
      x = g.add(prefix + "conv" + std::to_string(conv),
                Conv2dLayer{.filters = kFilters[block - 1],
                            .kh = 3,
                            .kw = 3,
                            .padding = Padding::same(),
                            .activation = Activation::relu},
                {x});
    x = g.add(prefix + "pool", Pool2dLayer{.window = {.kh = 2, .kw = 2, .stride_h = 2, .stride_w = 2}}, {x});
  }
  if (!top) return g;
  x = g.add("flatten", FlattenLayer{}, {x});
  x = g.add("fc1", DenseLayer{.units = 4096, .activation = Activation::relu}, {x});
  x = g.add("fc2", DenseLayer{.units = 4096, .activation = Activation::relu}, {x});
  g.add("predictions", DenseLayer{.units = 1000, .activation = Activation::softmax}, {x});
  return g;
}

Graph vgg16_graph(Index size, bool top) { return vgg(size, top, 3); }
Graph vgg19_graph(Index size, bool top) { return vgg(size, top, 4); }

}  // namespace

BackboneKind vgg16() {
  return {.name = "vgg16",
          .pooled = "block5_pool",
          .last_block_input = "block4_pool",
          .preprocessing = {.mode = PixelMode::caffe, .height = 224, .width = 224},
          .graph = vgg16_graph,
          .weight_files = {"vgg16_weights_tf_dim_ordering_tf_kernels_notop.h5",
                           "vgg16_weights_tf_dim_ordering_tf_kernels.h5"}};
}

BackboneKind vgg19() {
  return {.name = "vgg19",
          .pooled = "block5_pool",
          .last_block_input = "block4_pool",
          .preprocessing = {.mode = PixelMode::caffe, .height = 224, .width = 224},
          .graph = vgg19_graph,
          .weight_files = {"vgg19_weights_tf_dim_ordering_tf_kernels_notop.h5",
                           "vgg19_weights_tf_dim_ordering_tf_kernels.h5"}};
}

}  // namespace svnet::models
