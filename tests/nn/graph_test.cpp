#include "nn/graph/graph.h"

#include <catch2/catch.hpp>

#include "nn/graph/parameters.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

TEST_CASE("a graph infers the shape of each layer") {
  Graph graph;
  const NodeId image = graph.input("image", {15, 13, 3});
  auto shape_of = [&, count = 0](Layer layer) mutable {
    return graph.node(graph.add(joined("layer", count++), std::move(layer), {image})).shape;
  };
  const Padding same = Padding::same();
  CHECK(shape_of(Conv2dLayer{.filters = 8, .kh = 3, .kw = 5}) == Shape{13, 9, 8});
  CHECK(shape_of(Conv2dLayer{.filters = 8, .kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = same}) ==
        Shape{8, 7, 8});
  CHECK(shape_of(DepthwiseConv2dLayer{.kh = 3, .kw = 3, .multiplier = 2}) == Shape{13, 11, 6});
  CHECK(shape_of(SeparableConv2dLayer{.filters = 7, .kh = 3, .kw = 3, .multiplier = 2, .padding = same}) ==
        Shape{15, 13, 7});
  CHECK(shape_of(BatchNormLayer{}) == Shape{15, 13, 3});
  CHECK(shape_of(ActivationLayer{}) == Shape{15, 13, 3});
  CHECK(shape_of(Pool2dLayer{.window = {2, 2, 2, 2, Padding::valid()}}) == Shape{7, 6, 3});
  CHECK(shape_of(GlobalPool2dLayer{}) == Shape{3});
  CHECK(shape_of(GlobalPool2dLayer{.keep_dimensions = true}) == Shape{1, 1, 3});
  CHECK(shape_of(ZeroPadding2dLayer{Padding::of(1, 2, 3, 4)}) == Shape{18, 20, 3});
  CHECK(shape_of(FlattenLayer{}) == Shape{585});
  CHECK(shape_of(ReshapeLayer{{13, 45}}) == Shape{13, 45});
  CHECK(shape_of(DropoutLayer{}) == Shape{15, 13, 3});
  CHECK(graph.node(graph.add("sum", AddLayer{}, {image, image})).shape == Shape{15, 13, 3});
  const NodeId mean = graph.find("layer7"), kept = graph.find("layer8");
  for (const NodeId factor : {image, mean, kept}) {
    const std::string name = joined("product", factor);
    CHECK(graph.node(graph.add(name, MultiplyLayer{}, {image, factor})).shape == Shape{15, 13, 3});
    CHECK(graph.node(graph.add(name + "_swapped", MultiplyLayer{}, {factor, image})).shape == Shape{15, 13, 3});
  }
  CHECK(graph.node(graph.add("join", ConcatLayer{}, {image, image})).shape == Shape{15, 13, 6});
  CHECK(graph.node(graph.add("score", DenseLayer{.units = 2}, {graph.find("layer10")})).shape == Shape{2});
}

TEST_CASE("a graph says which layer does not fit, and why") {
  Graph graph;
  const NodeId image = graph.input("image", {5, 5, 3}), wide = graph.input("wide", {5, 6, 3}),
               flat = graph.input("flat", {8});
  const auto add = [&](Layer layer, std::vector<NodeId> inputs) {
    graph.add("block1_conv1", std::move(layer), std::move(inputs));
  };
  CHECK_THROWS_WITH(add(Conv2dLayer{.filters = 8, .kh = 7, .kw = 3}, {image}),
                    "[graph] layer 'block1_conv1': [Conv2D] a window of height 7 does not fit an image of height 5 "
                    "with padding 0 and 0");
  CHECK_THROWS_WITH(add(Conv2dLayer{}, {flat}), "[graph] layer 'block1_conv1': [Conv2D] expects images HxWxC, got 8");
  CHECK_THROWS_WITH(add(Conv2dLayer{}, {image, image}),
                    "[graph] layer 'block1_conv1': [Conv2D] takes one input, got 2");
  CHECK_THROWS_WITH(add(DenseLayer{}, {image}),
                    "[graph] layer 'block1_conv1': [Dense] expects features, got 5x5x3 (flatten first)");
  CHECK_THROWS_WITH(add(AddLayer{}, {image, wide}),
                    "[graph] layer 'block1_conv1': [Add] shapes differ: 5x5x3 and 5x6x3");
  CHECK_THROWS_WITH(add(AddLayer{}, {image}), "[graph] layer 'block1_conv1': [Add] takes two inputs or more, got 1");
  CHECK_THROWS_WITH(
      add(MultiplyLayer{}, {image, wide}),
      "[graph] layer 'block1_conv1': [Multiply] expects one shape, or HxWxC and 1x1xC or C, got 5x5x3 and "
      "5x6x3");
  CHECK_THROWS_WITH(add(MultiplyLayer{}, {image}), "[graph] layer 'block1_conv1': [Multiply] takes two inputs, got 1");
  CHECK_THROWS_WITH(add(ConcatLayer{}, {image, wide}),
                    "[graph] layer 'block1_conv1': [Concatenate] shapes differ before the last axis: 5x5x3 and 5x6x3");
  CHECK_THROWS_WITH(add(ConcatLayer{}, {image, flat}),
                    "[graph] layer 'block1_conv1': [Concatenate] shapes differ before the last axis: 5x5x3 and 8");
  CHECK_THROWS_WITH(add(GlobalPool2dLayer{}, {flat}),
                    "[graph] layer 'block1_conv1': [GlobalAveragePooling2D] expects images HxWxC, got 8");
  CHECK_THROWS_WITH(add(ReshapeLayer{{4, 4}}, {flat}),
                    "[graph] layer 'block1_conv1': [Reshape] cannot reshape 8 to 4x4");
  CHECK_THROWS_WITH(add(FlattenLayer{}, {7}), "[graph] layer 'block1_conv1' takes node 7, which does not exist");
  CHECK_THROWS_WITH(graph.input("image", {1}), "[graph] layer name 'image' is empty or taken");
  CHECK_THROWS_WITH(graph.input("", {1}), "[graph] layer name '' is empty or taken");
  CHECK(graph.nodes().size() == 3);  // a failed add() leaves no node
}

TEST_CASE("a graph finds layers by name and suggests the nearest") {
  Graph graph;
  graph.input("image", {5, 5, 3});
  const NodeId conv = graph.add("block1_conv1", Conv2dLayer{}, {0});
  CHECK(graph.find("block1_conv1") == conv);
  CHECK(graph.contains("image"));
  CHECK_THROWS_WITH(graph.find("block1_conv"), "[graph] no layer 'block1_conv', did you mean 'block1_conv1'?");
}

TEST_CASE("parameters have Keras' names, shapes and order") {
  Graph graph;
  NodeId x = graph.input("image", {9, 9, 3});
  x = graph.add("conv", Conv2dLayer{.filters = 8, .kh = 3, .kw = 5}, {x});
  x = graph.add("depth", DepthwiseConv2dLayer{.kh = 3, .kw = 3, .multiplier = 2}, {x});
  x = graph.add("sep", SeparableConv2dLayer{.filters = 4, .kh = 3, .kw = 3, .multiplier = 2, .bias = false}, {x});
  x = graph.add("norm", BatchNormLayer{}, {x});
  x = graph.add("flat", FlattenLayer{}, {x});
  x = graph.add("score", DenseLayer{.units = 2}, {x});
  const Parameters parameters = initial_parameters(graph, 1);
  const std::vector<std::pair<std::string, Shape>> expected{{"conv/kernel", {3, 5, 3, 8}},
                                                            {"conv/bias", {8}},
                                                            {"depth/depthwise_kernel", {3, 3, 8, 2}},
                                                            {"depth/bias", {16}},
                                                            {"sep/depthwise_kernel", {3, 3, 16, 2}},
                                                            {"sep/pointwise_kernel", {1, 1, 32, 4}},
                                                            {"norm/gamma", {4}},
                                                            {"norm/beta", {4}},
                                                            {"norm/moving_mean", {4}},
                                                            {"norm/moving_variance", {4}},
                                                            {"score/kernel", {12, 2}},
                                                            {"score/bias", {2}}};
  REQUIRE(parameters.items().size() == expected.size());
  Index count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [name, value] = parameters.items()[i];
    CHECK(name == expected[i].first);
    CHECK(value.shape() == expected[i].second);
    CHECK(value.wants_gradient() == (name.find("moving") == std::string::npos));
    count += value.size();
  }
  CHECK(graph.parameter_count() == count);
  CHECK(trainable(graph, parameters).size() == expected.size() - 2);
  CHECK_THROWS_WITH(parameters.at("conv/weight"), "[parameters] there is no 'conv/weight'");
  CHECK(same_bits(parameters.at("norm/moving_variance"), Tensor::full({4}, 1)));
  CHECK_FALSE(
      same_bits(parameters.at("conv/kernel").detached(), initial_parameters(graph, 2).at("conv/kernel").detached()));
}

TEST_CASE("ancestors are the layers that an output depends on") {
  Graph graph;
  const NodeId image = graph.input("image", {4});
  const NodeId a = graph.add("a", DenseLayer{.units = 3}, {image}), b = graph.add("b", DenseLayer{.units = 3}, {image});
  const NodeId c = graph.add("c", AddLayer{}, {a, a});
  CHECK(graph.ancestors({c}) == std::vector<bool>{true, true, false, true});
  CHECK(graph.ancestors({b}) == std::vector<bool>{true, false, true, false});
  CHECK(graph.inputs() == std::vector<NodeId>{image});
  CHECK(graph.output() == c);
}

TEST_CASE("a layer with attributes that make no sense is refused by its name") {
  Graph g;
  const NodeId image = g.input("image", {8, 8, 3});
  CHECK_THROWS_WITH(g.add("conv", Conv2dLayer{.filters = 0}, {image}),
                    "[graph] layer 'conv': [Conv2D] gives 8x8x0, which is empty or too large");
  CHECK_THROWS_WITH(g.add("drop", DropoutLayer{1.0}, {image}),
                    "[graph] layer 'drop': [Dropout] rate 1 is outside [0, 1)");
  CHECK_THROWS_WITH(g.add("pad", ZeroPadding2dLayer{Padding::of(0, -1, 0, 0)}, {image}),
                    "[graph] layer 'pad': [ZeroPadding2D] needs four numbers of zeros, none negative");
  // Sizes whose sums or products overflow 64 bits.
  constexpr Index kHuge = Index{1} << 62;
  CHECK_THROWS_WITH(g.add("pad", ZeroPadding2dLayer{Padding::of(kHuge, kHuge, 0, 0)}, {image}),
                    Catch::Contains("zeros are too many"));
  CHECK_THROWS_WITH(g.add("conv", Conv2dLayer{.filters = 4, .kh = kHuge}, {image}), Catch::Contains("is too large"));
  const NodeId large = g.add("large", ZeroPadding2dLayer{Padding::of(1 << 18, 0, 1 << 18, 0)}, {image});
  CHECK_THROWS_WITH(g.add("wide", Conv2dLayer{.filters = 256}, {large}),
                    Catch::Contains("[Conv2D] gives 262152x262152x256, which is empty or too large"));
}
