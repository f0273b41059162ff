// Each layer of each backbone in ONNX, and layers that no backbone has.
#include <catch2/catch.hpp>
#include <cmath>

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
