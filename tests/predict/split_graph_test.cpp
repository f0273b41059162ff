#include "predict/split_graph.h"

#include <catch2/catch.hpp>

#include "models/pose_head.h"
#include "models/sv_net.h"
#include "nn/graph/run.h"
#include "small_model.h"

using namespace svnet;
using namespace svnet::predict;

namespace {

/// Made-up parameters: batch norms that change every value, and kernels of about the size of an initialiser's.
Parameters made_up_parameters(const Graph& graph) {
  Parameters parameters = initial_parameters(graph, 7);
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters) {
      if (spec.name == "kernel") continue;
      Tensor values = small_weights(spec.shape, 0.4f);
      if (spec.name != "beta" && spec.name != "bias")
        for (Index i = 0; i < values.size(); ++i) values.data<float>()[i] += 0.9f;
      parameters.set(node.parameter_name(spec), values);
    }
  return parameters;
}

/// x · kernel + bias, in f64.
std::vector<double> dense(const std::vector<double>& x, const Tensor& kernel, const Tensor& bias) {
  const Index n = kernel.dim(1);
  std::vector<double> y;
  for (Index i = 0; i < n; ++i) {
    double sum = bias.defined() ? bias.data<float>()[i] : 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += x[k] * kernel.data<float>()[static_cast<Index>(k) * n + i];
    y.push_back(sum);
  }
  return y;
}

/// The layers between the two graphs of a split.
Tensor between(const SplitGraph& split, const Tensor& c, const Tensor& angles) {
  const auto relu = [](std::vector<double> x) {
    for (double& value : x) value = std::max(value, 0.0);
    return x;
  };
  const auto own = angles.values<float>();
  const auto h = relu(dense({own.begin(), own.end()}, split.angle_kernel, c));
  const auto z = dense(relu(dense(h, split.kernel, split.bias)), split.last_kernel, split.last_bias);
  Tensor result = Tensor::empty({1, static_cast<Index>(z.size())});
  std::ranges::transform(z, result.data<float>(), [](double x) { return static_cast<float>(x); });
  return result;
}

/// The largest difference between the whole graph and its parts, over three values of the first input and five of the
/// second.
double largest_difference(const Graph& graph, const Parameters& parameters, const SplitGraph& split) {
  const Index firsts = element_count(graph.node(graph.inputs()[0]).shape),
              others = element_count(graph.node(graph.inputs()[1]).shape);
  double largest = 0;
  for (int which = 0; which < 3; ++which) {
    const Tensor first = small_weights({1, firsts}, 0.5f + static_cast<float>(which));
    const Tensor once = run_inference(split.once.graph, split.once.parameters, {first}, {split.once.graph.output()})[0];
    for (int i = 0; i < 5; ++i) {
      const Tensor other = small_weights({1, others}, static_cast<float>(i));
      const Tensor parts = run_inference(split.rest.graph, split.rest.parameters, {between(split, once, other)},
                                         {split.rest.graph.output()})[0];
      const Tensor whole = run_inference(graph, parameters, {first, other}, {graph.output()})[0];
      REQUIRE(parts.shape() == whole.shape());
      for (Index k = 0; k < whole.size(); ++k)
        largest = std::max<double>(largest, std::abs(parts.data<float>()[k] - whole.data<float>()[k]));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("SV-net is split where the pose enters, with its batch norms folded") {
  for (const double dropout : {0.0, 0.5}) {
    const Graph graph = models::sv_net({.features = 30, .width = 12, .dropout = dropout});
    const Parameters parameters = made_up_parameters(graph);
    const auto split = split_graph(graph, parameters, graph.output());
    REQUIRE(split);
    CHECK(largest_difference(graph, parameters, *split) < 2e-6);
    CHECK(split->once.parameters.at("mlp2_1_relu/kernel").shape() == Shape{12, 12});
    CHECK(split->angle_kernel.shape() == Shape{2, 12});
    CHECK(split->kernel.shape() == Shape{12, 12});
    CHECK(split->layer == "mlp2_2_relu");
    CHECK(split->once.graph.inputs().size() == 1);
    CHECK(split->last_kernel.shape() == Shape{12, 1});
    CHECK(split->rest.graph.node(split->rest.graph.inputs()[0]).shape == Shape{1});
    CHECK(split->rest.graph.nodes().size() == 2);  // with the sigmoid
    for (const FoldedGraph* part : {&split->once, &split->rest})
      for (const auto& node : part->graph.nodes()) CHECK_FALSE(node.is<BatchNormLayer>());
  }
}

TEST_CASE("a concatenation of several parts in any order is split") {
  Graph graph;
  const NodeId first = graph.input("picture", {6}), pose = graph.input("pose", {3});
  const NodeId deep = graph.add("deep", DenseLayer{.units = 5, .activation = Activation::relu}, {first});
  const NodeId all = graph.add("all", ConcatLayer{}, {first, pose, deep});
  const NodeId hidden = graph.add("hidden", DenseLayer{.units = 7, .activation = Activation::relu},
                                  {graph.add("drop", DropoutLayer{0.5}, {all})});
  const NodeId second = graph.add("second", DenseLayer{.units = 4, .activation = Activation::relu}, {hidden});
  graph.add("out", DenseLayer{.units = 2, .bias = false}, {second});
  const Parameters parameters = made_up_parameters(graph);
  const auto split = split_graph(graph, parameters, graph.output());
  REQUIRE(split);
  CHECK(largest_difference(graph, parameters, *split) < 2e-6);
  CHECK(split->once.parameters.at("hidden/kernel").shape() == Shape{11, 7});
  CHECK_FALSE(split->last_bias.defined());
}

TEST_CASE("graphs of another form are not split") {
  const auto is_split = [](const Graph& graph) {
    return split_graph(graph, initial_parameters(graph, 1), graph.output()).has_value();
  };
  CHECK_FALSE(is_split(models::linear_head(4)));
  CHECK_FALSE(is_split(models::mixed_head(4, 2)));

  const auto ends_in = [](Activation first, Activation second, Activation third) {
    Graph graph;
    const NodeId all = graph.add("all", ConcatLayer{}, {graph.input("picture", {6}), graph.input("pose", {3})});
    const NodeId hidden = graph.add("hidden", DenseLayer{.units = 4, .activation = first}, {all});
    const NodeId last = graph.add("last", DenseLayer{.units = 3, .activation = second}, {hidden});
    graph.add("out", DenseLayer{.units = 2, .activation = third}, {last});
    return graph;
  };
  constexpr Activation kRelu = Activation::relu, kNone = Activation::none, kSigmoid = Activation::sigmoid;
  CHECK(is_split(ends_in(kRelu, kRelu, kNone)));
  CHECK_FALSE(is_split(ends_in(kSigmoid, kRelu, kNone)));
  CHECK_FALSE(is_split(ends_in(kRelu, kSigmoid, kNone)));
  CHECK_FALSE(is_split(ends_in(kRelu, kNone, kNone)));
  CHECK_FALSE(is_split(ends_in(kRelu, kRelu, kSigmoid)));

  Graph activated;  // the concatenation is changed before the dense layer
  NodeId x = activated.input("picture", {6}), pose = activated.input("pose", {3});
  x = activated.add("relu", ActivationLayer{}, {activated.add("all", ConcatLayer{}, {x, pose})});
  activated.add("out", DenseLayer{.units = 2}, {x});
  CHECK_FALSE(is_split(activated));

  Graph twice;  // the picture enters again after the dense layer
  x = twice.input("picture", {6}), pose = twice.input("pose", {3});
  const NodeId hidden = twice.add("hidden", DenseLayer{.units = 2}, {twice.add("all", ConcatLayer{}, {x, pose})});
  twice.add("out", DenseLayer{.units = 2}, {twice.add("again", ConcatLayer{}, {hidden, x})});
  CHECK_FALSE(is_split(twice));

  Graph read_twice;  // the concatenation has two readers
  x = read_twice.input("picture", {6}), pose = read_twice.input("pose", {3});
  const NodeId all = read_twice.add("all", ConcatLayer{}, {x, pose});
  const NodeId left = read_twice.add("left", DenseLayer{.units = 2}, {all});
  read_twice.add("sum", AddLayer{}, {left, read_twice.add("right", DenseLayer{.units = 2}, {all})});
  CHECK_FALSE(is_split(read_twice));
}
