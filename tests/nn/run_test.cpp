#include "nn/graph/run.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "nn/allocations.h"
#include "nn/autograd.h"
#include "nn/numbers.h"
#include "nn/ops/activations.h"
#include "nn/ops/batch_norm.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/pooling.h"
#include "nn/ops/shaping.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// Two inputs, batch norm, a shortcut, dropout, a concatenation.
Graph small_graph() {
  Graph graph;
  const NodeId image = graph.input("image", {7, 5, 3}), angles = graph.input("angles", {2});
  const NodeId conv =
      graph.add("conv", Conv2dLayer{.filters = 4, .kh = 3, .kw = 3, .padding = Padding::same()}, {image});
  const NodeId norm = graph.add("norm", BatchNormLayer{}, {conv});
  const NodeId sum = graph.add("sum", AddLayer{}, {norm, conv});
  const NodeId pool = graph.add("pool", GlobalPool2dLayer{}, {sum});
  const NodeId drop = graph.add("drop", DropoutLayer{.rate = 0.5}, {pool});
  const NodeId join = graph.add("join", ConcatLayer{}, {drop, angles});
  graph.add("score", DenseLayer{.units = 1, .activation = Activation::sigmoid}, {join});
  return graph;
}

const Tensor kImages = random_tensor({4, 7, 5, 3}, 1), kAngles = random_tensor({4, 2}, 2);

}  // namespace

TEST_CASE("inference runs the layers with the moving statistics and without dropout") {
  const Graph graph = small_graph();
  Parameters parameters = initial_parameters(graph, 3, DType::f64);
  parameters.set("norm/moving_mean", random_tensor({4}, 4));
  parameters.set("norm/moving_variance", random_tensor({4}, 5, DType::f64, 0.5, 2));
  const auto p = [&](const char* name) { return parameters.at(name).detached(); };
  const Tensor conv =
      ops::bias_add(ops::conv2d(kImages, p("conv/kernel"), {.padding = Padding::same()}), p("conv/bias"));
  const Tensor norm = ops::batch_norm_inference(conv, p("norm/gamma"), p("norm/beta"), p("norm/moving_mean"),
                                                p("norm/moving_variance"), 1e-3);
  const Tensor joined = ops::concat({ops::global_average_pool2d(ops::add({norm, conv})), kAngles});
  const Tensor score = ops::sigmoid(ops::bias_add(ops::dense(joined, p("score/kernel")), p("score/bias")));

  const auto results =
      run_inference(graph, parameters, {kImages, kAngles}, {graph.output(), graph.find("norm"), graph.output()});
  REQUIRE(results.size() == 3);
  CHECK(same_bits(results[0], score));
  CHECK(same_bits(results[1], norm));
  CHECK(same_bits(results[2], score));
}

TEST_CASE("inference records nothing, training does until its tape has run") {
  const Graph graph = small_graph();
  Parameters parameters = initial_parameters(graph, 3, DType::f64);
  const Tensor images = kImages.clone();
  const Tensor wanting = kAngles.as_parameter();
  CHECK_FALSE(run_inference(graph, parameters, {images, wanting}, {graph.output()})[0].wants_gradient());
  CHECK(images.unique());
  CHECK(parameters.at("conv/kernel").unique());

  Tensor score = run_training(graph, parameters, {images, kAngles}, {graph.output()}, {})[0];
  CHECK(score.wants_gradient());
  CHECK_FALSE(images.unique());
  autograd::GradientMap gradients;
  autograd::backward(score, gradients, Tensor::full(score.shape(), 1, DType::f64));
  CHECK(images.unique());
  CHECK(parameters.at("conv/kernel").unique());
  for (const Tensor& parameter : trainable(graph, parameters))
    CHECK(gradients.of(parameter).shape() == parameter.shape());
}

TEST_CASE("training uses the batch's statistics, moves the moving ones and drops") {
  const Graph graph = small_graph();
  Parameters parameters = initial_parameters(graph, 3, DType::f64);
  const NodeId norm = graph.find("norm"), drop = graph.find("drop");
  const auto step = [&](std::uint64_t number) {
    return run_training(graph, parameters, {kImages, kAngles}, {norm, drop}, {.seed = 9, .step = number});
  };
  const auto first = step(0), again = step(0), second = step(1);
  double sum = 0, squares = 0;  // of channel 0
  for (Index i = 0; i < first[0].size(); i += 4)
    sum += first[0].data<double>()[i], squares += std::pow(first[0].data<double>()[i], 2);
  CHECK(sum / 140 == Approx(0).margin(1e-12));
  CHECK(squares / 140 == Approx(1).margin(0.05));
  CHECK_FALSE(same_bits(parameters.at("norm/moving_mean"), Tensor::zeros({4}, DType::f64)));
  CHECK_FALSE(parameters.at("norm/moving_mean").wants_gradient());
  CHECK(same_bits(first[1].detached(), again[1].detached()));
  CHECK_FALSE(same_bits(first[1].detached(), second[1].detached()));
}

TEST_CASE("two dropout layers of one step drop different elements") {
  Graph graph;
  const NodeId x = graph.input("x", {1000});
  graph.add("a", DropoutLayer{}, {x});
  graph.add("b", DropoutLayer{}, {x});
  Parameters parameters;
  const auto y = run_training(graph, parameters, {Tensor::full({1, 1000}, 1)}, {1, 2}, {});
  CHECK_FALSE(same_bits(y[0], y[1]));
}

TEST_CASE("values are released once their last reader has run") {
  constexpr Index kSize = 1 << 13;  // small enough that freed storage is not kept
  Graph graph;
  NodeId x = graph.input("x", {kSize});
  for (int i = 0; i < 20; ++i) x = graph.add(joined("layer", i), ActivationLayer{Activation::sigmoid}, {x});
  Parameters parameters;
  const Tensor input = Tensor::full({1, kSize}, 1);
  const std::size_t value = kSize * sizeof(float), before = bytes_in_use();
  reset_peak();
  run_inference(graph, parameters, {input}, {x});
  CHECK(peak_bytes() - before >= 2 * value);
  CHECK(peak_bytes() - before < 3 * value);
  reset_peak();
  const auto kept = run_training(graph, parameters, {input.as_parameter()}, {x}, {});
  CHECK(bytes_in_use() - before >= 20 * value);
  autograd::GradientMap gradients;
  autograd::backward(kept[0], gradients, Tensor::full({1, kSize}, 1));
  CHECK(bytes_in_use() - before < 3 * value);  // the output and the gradient
}

TEST_CASE("running says which inputs do not fit") {
  const Graph graph = small_graph();
  const Parameters parameters = initial_parameters(graph, 3, DType::f64);
  const auto run = [&](const std::vector<Tensor>& inputs) {
    run_inference(graph, parameters, inputs, {graph.output()});
  };
  CHECK_THROWS_WITH(run({kImages}), "[graph] takes 2 inputs, got 1");
  CHECK_THROWS_WITH(run({kImages, {}}), "[graph] input 'angles' is empty");
  CHECK_THROWS_WITH(run({kImages, Tensor::zeros({4, 3}, DType::f64)}), "[graph] input 'angles' expects Nx2, got 4x3");
  CHECK_THROWS_WITH(run({kAngles, kAngles}), "[graph] input 'image' expects Nx7x5x3, got 4x2");
  CHECK_THROWS_WITH(run({kImages.to(DType::f32), kAngles}), "[conv2d] operands mix f32 and f64");
}

TEST_CASE("an input that no wanted layer reads is not checked") {
  const Graph graph = small_graph();
  const Parameters parameters = initial_parameters(graph, 3, DType::f64);
  CHECK(run_inference(graph, parameters, {kImages, {}}, {graph.find("pool")})[0].shape() == Shape{4, 4});
}
