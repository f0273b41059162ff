// Each layer of each backbone in ONNX, and layers that no backbone has.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "io/onnx/layer_nodes.h"
#include "io/onnx/onnx_run.h"
#include "models/backbone.h"
#include "nn/runtime/folding.h"
#include "nn/runtime/inference.h"

using namespace svnet;
using namespace svnet::io;

namespace {

Tensor waves(Shape shape) {
  Tensor tensor = Tensor::empty(std::move(shape));
  for (Index i = 0; i < tensor.size(); ++i)
    tensor.data<float>()[i] = std::sin(0.37f * static_cast<float>(i % 1013)) + 0.3f * std::cos(static_cast<float>(i));
  return tensor;
}

/// The largest difference between the graph and its ONNX twin, relative to the largest value. The graph has one input.
double difference(const Graph& graph, const Parameters& parameters) {
  const GraphNode& input = graph.node(graph.inputs()[0]);
  Shape shape = input.shape;
  shape.insert(shape.begin(), 2);
  const Tensor x = waves(shape);
  const Tensor wanted = Inference(graph, parameters, graph.output()).run({x});

  OnnxGraph to;
  to.inputs.push_back({"x", {}});
  OnnxValue value{.name = "x", .shape = input.shape};
  if (input.shape.size() == 3) {
    value.name = to.add("Transpose", "first", {"x"}, {{"perm", std::vector<std::int64_t>{0, 3, 1, 2}}});
    value.channels_first = input.shape;
  }
  OnnxLayers layers(to, StoredPrecision::f32, "layer/");
  const FoldedGraph network = folded(graph, parameters, graph.output());
  const std::string last = layers.rows_of(layers.add(network.graph, network.parameters, {value}));
  to.add("Identity", "y", {last});
  to.outputs.push_back({"y", {}});
  const auto values = x.values<float>();
  const OnnxTensor got = run_onnx(to, {{"x", {x.shape(), {values.begin(), values.end()}}}});

  REQUIRE(static_cast<Index>(got.values.size()) == wanted.size());
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < got.values.size(); ++i) {
    most = std::max(most, static_cast<double>(std::abs(got.values[i] - wanted.data<float>()[i])));
    largest = std::max(largest, static_cast<double>(std::abs(wanted.data<float>()[i])));
  }
  return most / largest;
}

double difference(const Graph& graph) { return difference(graph, initial_parameters(graph, 7)); }

}  // namespace

TEST_CASE("small backbones are the same in ONNX") {
  for (const char* name : {"tiny_xception", "mobilenet", "mobilenet_v2"}) {
    CAPTURE(name);
    const models::Backbone backbone = models::random_backbone(name, "", 3);
    CHECK(difference(backbone.graph(), backbone.parameters()) < 2e-5);
  }
}

TEST_CASE("layers that are read as rows and as images are the same in ONNX") {
  Graph g;
  NodeId x = g.input("image", {9, 7, 3});
  const NodeId padded = g.add("pad", ZeroPadding2dLayer{Padding::of(1, 2, 0, 1)}, {x});
  const NodeId conv = g.add("conv",
                            Conv2dLayer{.filters = 8,
                                        .kh = 3,
                                        .kw = 2,
                                        .stride_h = 2,
                                        .padding = Padding::same(),
                                        .activation = Activation::hard_swish},
                            {padded});
  const NodeId pool = g.add(
      "pool", Pool2dLayer{.kind = PoolKind::average, .window = {.kh = 2, .kw = 2, .padding = Padding::same()}}, {conv});
  const NodeId most = g.add("most", Pool2dLayer{.window = {.kh = 2, .kw = 2, .padding = Padding::same()}}, {conv});
  const NodeId both = g.add("both", ConcatLayer{}, {pool, most});
  const NodeId depthwise =
      g.add("depthwise",
            DepthwiseConv2dLayer{
                .kh = 3, .kw = 3, .multiplier = 2, .padding = Padding::same(), .activation = Activation::relu6},
            {both});
  const NodeId factor = g.add("factor", ActivationLayer{Activation::hard_sigmoid},
                              {g.add("squeeze", GlobalPool2dLayer{.keep_dimensions = true}, {depthwise})});
  const NodeId scaled = g.add("scaled", MultiplyLayer{}, {depthwise, factor});
  const NodeId normed = g.add("norm", BatchNormLayer{}, {scaled});
  const NodeId separable = g.add(
      "separable",
      SeparableConv2dLayer{.filters = 4, .kh = 3, .kw = 3, .padding = Padding::same(), .activation = Activation::relu},
      {normed});
  const NodeId flat = g.add("flat", FlattenLayer{}, {separable});
  const NodeId hidden = g.add("hidden", DenseLayer{.units = 12, .activation = Activation::sigmoid}, {flat});
  const NodeId image = g.add("image_again", ReshapeLayer{{2, 2, 3}}, {hidden});
  const NodeId again =
      g.add("conv_again", Conv2dLayer{.filters = 3, .kh = 2, .kw = 2, .padding = Padding::same()}, {image});
  const NodeId sum = g.add("sum", AddLayer{}, {again, image, image});
  const NodeId beside = g.add("beside", ConcatLayer{}, {g.add("flat_sum", FlattenLayer{}, {sum}), hidden});
  const NodeId classes = g.add("classes", DenseLayer{.units = 5}, {beside});
  const NodeId softmax = g.add("softmax", ActivationLayer{Activation::softmax}, {classes});
  g.add("all", ConcatLayer{}, {softmax, beside});
  CHECK(difference(g) < 1e-5);
}

TEST_CASE("zeros around an image are the same in ONNX, whatever layer reads them") {
  const auto with = [](const std::function<NodeId(Graph&, NodeId)>& add) {
    Graph g;
    const NodeId image = g.input("image", {5, 6, 2});
    const NodeId padded = g.add("pad", ZeroPadding2dLayer{Padding::of(1, 2, 0, 3)}, {image});
    add(g, padded);
    return difference(g);
  };
  const Conv2dLayer conv{.filters = 3, .kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = Padding::same()};
  CHECK(with([](Graph&, NodeId padded) { return padded; }) < 1e-6);
  CHECK(with([](Graph& g, NodeId padded) { return g.add("flat", FlattenLayer{}, {padded}); }) < 1e-6);
  CHECK(with([](Graph& g, NodeId padded) { return g.add("shaped", ReshapeLayer{{8 * 9 * 2}}, {padded}); }) < 1e-6);
  CHECK(with([](Graph& g, NodeId padded) {
          return g.add("dense", DenseLayer{.units = 4}, {g.add("flat", FlattenLayer{}, {padded})});
        }) < 1e-5);
  for (const PoolKind kind : {PoolKind::max, PoolKind::average}) {
    CHECK(with([&](Graph& g, NodeId padded) {
            const Pool2dLayer pool{.kind = kind, .window = {.kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2}};
            return g.add("conv", conv, {g.add("pool", pool, {padded})});
          }) < 1e-5);
    CHECK(with([&](Graph& g, NodeId padded) { return g.add("pool", GlobalPool2dLayer{.kind = kind}, {padded}); }) <
          1e-5);
  }
  CHECK(with([&](Graph& g, NodeId padded) {
          return g.add("conv", conv, {g.add("sigmoid", ActivationLayer{Activation::sigmoid}, {padded})});
        }) < 1e-5);
  CHECK(with([&](Graph& g, NodeId padded) {
          const NodeId again = g.add("again", ZeroPadding2dLayer{Padding::of(1, 0, 1, 0)}, {padded});
          return g.add("conv", conv, {again});
        }) < 1e-5);
  CHECK(with([](Graph& g, NodeId padded) { return g.add("sum", AddLayer{}, {padded, padded}); }) < 1e-6);
  CHECK(with([](Graph& g, NodeId padded) {
          const NodeId both = g.add("both", ConcatLayer{}, {padded, padded});
          return g.add("norm", BatchNormLayer{}, {both});
        }) < 1e-5);
}

TEST_CASE("layers of features are the same in ONNX") {
  Graph g;
  const NodeId x = g.input("x", {6});
  const NodeId same = g.add("same", ReshapeLayer{{6}}, {x});
  const NodeId hidden = g.add("hidden", DenseLayer{.units = 6, .bias = false}, {same});
  const NodeId normed = g.add("norm", BatchNormLayer{}, {g.add("relu", ActivationLayer{Activation::relu}, {hidden})});
  const NodeId sum = g.add("sum", AddLayer{}, {normed, x, hidden});
  const NodeId product = g.add("product", MultiplyLayer{}, {sum, x});
  const NodeId beside = g.add("beside", ConcatLayer{}, {product, x});
  const NodeId sigmoid = g.add("sigmoid", ActivationLayer{Activation::sigmoid}, {beside});
  g.add("out", DropoutLayer{0.5}, {sigmoid});
  CHECK(difference(g) < 1e-5);
}

TEST_CASE("a factor per channel is the same in ONNX, whatever its shape and its place") {
  for (const Shape& shape : {Shape{3}, Shape{1, 1, 3}})
    for (const bool first : {false, true}) {
      CAPTURE(shape.size(), first);
      Graph g;
      const NodeId image = g.input("image", {4, 5, 3});
      const NodeId mean = g.add("mean", GlobalPool2dLayer{}, {image});
      NodeId factor = g.add("factor", DenseLayer{.units = 3}, {mean});
      if (shape.size() == 3) factor = g.add("shaped", ReshapeLayer{shape}, {factor});
      const NodeId scaled =
          g.add("scaled", MultiplyLayer{}, first ? std::vector{factor, image} : std::vector{image, factor});
      g.add("conv", Conv2dLayer{.filters = 2, .kh = 3, .kw = 3, .stride_h = 2, .padding = Padding::same()}, {scaled});
      CHECK(difference(g) < 1e-5);
    }
}

TEST_CASE("a norm of rows that are an image is refused with its name") {
  Graph g;
  const NodeId rows = g.add("rows", DenseLayer{.units = 12}, {g.input("x", {4})});
  g.add("norm", BatchNormLayer{}, {g.add("image", ReshapeLayer{{2, 2, 3}}, {rows})});
  CHECK_THROWS_WITH(difference(g), "[onnx] norm: a norm of 2x2x3 cannot be exported");
}
