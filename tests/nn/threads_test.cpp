// The same bits for 1, 2 and 8 threads: every kernel at sizes of several chunks, and a network's forward and backward
// passes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "base/instruction_sets.h"
#include "nn/autograd.h"
#include "nn/graph/run.h"
#include "nn/kernels/batch_norm/batch_norm.h"
#include "nn/kernels/gemm.h"
#include "nn/numbers.h"
#include "nn/ops/activations.h"
#include "nn/ops/batch_norm.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/dropout.h"
#include "nn/ops/losses.h"
#include "nn/ops/pooling.h"
#include "nn/optim/optimizer.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// Restores the number of threads of the shared pool.
class Threads {
 public:
  ~Threads() { Parallel::shared().resize(before_); }

 private:
  int before_ = Parallel::shared().threads();
};

void check_same(const std::string& what, const std::function<std::vector<Tensor>()>& compute) {
  Threads restored;
  Parallel::shared().resize(1);
  const auto one = compute();
  for (int threads : {2, 8}) {
    Parallel::shared().resize(threads);
    const auto many = compute();
    REQUIRE(many.size() == one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      INFO(what << ", result " << i << ", " << threads << " threads");
      CHECK(same_bits(one[i], many[i]));
    }
  }
}

/// The output and the gradients of all inputs.
std::vector<Tensor> with_gradients(const std::function<Tensor(const std::vector<Tensor>&)>& function,
                                   std::vector<Tensor> inputs) {
  for (Tensor& x : inputs) x = x.as_parameter();
  const Tensor y = function(inputs);
  autograd::GradientMap gradients;
  autograd::backward(y, gradients, random_tensor(y.shape(), 99, y.dtype()));
  std::vector<Tensor> all{y.detached()};
  for (const Tensor& x : inputs) all.push_back(gradients.of(x));
  return all;
}

}  // namespace

TEST_CASE("gemm, moments and sums give the same bits for any number of threads") {
  for (DType dtype : {DType::f32, DType::f64})
    with_dtype(dtype, [&]<class T>() {
      for (kernels::GemmShape s : {kernels::GemmShape{.m = 33, .n = 1030, .k = 77}, {.m = 1000, .n = 45, .k = 77}})
        check_same("gemm", [&] {
          const Tensor a = random_tensor({s.m, s.k}, 1, dtype), b = random_tensor({s.k, s.n}, 2, dtype);
          Tensor c = Tensor::empty({s.m, s.n}, dtype);
          kernels::gemm<T>(Parallel::shared(), s, a.data<T>(), b.data<T>(), c.data<T>());
          return std::vector{c};
        });
      check_same("sums", [&] {
        const Tensor a = random_tensor({5001, 7}, 3, dtype), b = random_tensor({5001, 7}, 4, dtype);
        Tensor mean = Tensor::empty({7}, dtype), variance = mean.clone(), sums = mean.clone();
        kernels::moments<T>(Parallel::shared(), {5001, 7}, a.data<T>(), mean.data<T>(), variance.data<T>());
        kernels::column_sums<T>(Parallel::shared(), {5001, 7}, a.data<T>(), b.data<T>(), sums.data<T>());
        return std::vector{mean, variance, sums};
      });
    });
}

TEST_CASE("operations and their gradients give the same bits for any number of threads") {
  const Tensor x = random_tensor({3, 33, 31, 5}, 1, DType::f32);
  using In = const std::vector<Tensor>&;
  const auto check_op = [](const std::string& what, auto function, const std::vector<Tensor>& inputs) {
    check_same(what, [&] { return with_gradients(function, inputs); });
  };
  const ops::ConvOptions same{.padding = Padding::same()};
  for (Index kernel : {1, 3})
    check_op("conv2d", [&](In in) { return ops::conv2d(in[0], in[1], same); },
             {x, random_tensor({kernel, kernel, 5, 17}, 2, DType::f32)});
  for (Index multiplier : {1, 2})
    check_op("depthwise", [&](In in) { return ops::depthwise_conv2d(in[0], in[1], same); },
             {x, random_tensor({3, 3, 5, multiplier}, 3, DType::f32)});
  const WindowOptions window{.kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = Padding::same()};
  check_op("max_pool2d", [&](In in) { return ops::max_pool2d(in[0], window); }, {x});
  check_op("average_pool2d", [&](In in) { return ops::average_pool2d(in[0], window); }, {x});
  check_op("batch_norm",
           [&](In in) {
             Tensor mean = Tensor::zeros({5}), variance = Tensor::full({5}, 1);
             return ops::batch_norm_training(in[0], in[1], in[2], mean, variance, {});
           },
           {x, random_tensor({5}, 4, DType::f32), random_tensor({5}, 5, DType::f32)});
  check_op("bias_add", [&](In in) { return ops::bias_add(in[0], in[1]); }, {x, random_tensor({5}, 6, DType::f32)});
  check_op("sigmoid", [&](In in) { return ops::sigmoid(in[0]); }, {random_tensor({70001}, 7, DType::f32)});
  check_op("softmax", [&](In in) { return ops::softmax(in[0]); }, {random_tensor({101, 9}, 8, DType::f32)});
  check_op("dropout", [&](In in) { return ops::dropout(in[0], 0.3, {1, 2}); }, {random_tensor({70001}, 9, DType::f32)});
  check_op("dense", [&](In in) { return ops::dense(in[0], in[1]); },
           {random_tensor({32, 401}, 10, DType::f32), random_tensor({401, 203}, 11, DType::f32)});
}

namespace {

Graph small_network() {
  Graph graph;
  NodeId x = graph.input("image", {17, 19, 3});
  x = graph.add("conv", Conv2dLayer{.filters = 8, .kh = 3, .kw = 3, .padding = Padding::same(), .bias = false}, {x});
  const NodeId shortcut = x = graph.add("norm", BatchNormLayer{}, {x});
  x = graph.add(
      "separable",
      SeparableConv2dLayer{.filters = 8, .kh = 3, .kw = 3, .padding = Padding::same(), .activation = Activation::relu},
      {x});
  x = graph.add("sum", AddLayer{}, {x, shortcut});
  x = graph.add("pool", Pool2dLayer{.window = {2, 2, 2, 2, Padding::same()}}, {x});
  x = graph.add("flat", FlattenLayer{}, {x});
  x = graph.add("drop", DropoutLayer{.rate = 0.5}, {x});
  x = graph.add("hidden", DenseLayer{.units = 70, .activation = Activation::relu}, {x});
  graph.add("score", DenseLayer{.units = 4, .initializer = Initializer::he_normal}, {x});
  return graph;
}

/// The logits and gradients of each step, the parameters after the last one, and the network's output then.
std::vector<Tensor> trained(const Graph& graph, std::uint64_t steps) {
  const Tensor images = random_tensor({6, 17, 19, 3}, 1, DType::f32);
  Parameters parameters = initial_parameters(graph, 7);
  const auto weights = trainable(graph, parameters);
  const auto optimizer = adam(weights);
  std::vector<Tensor> seen;
  for (std::uint64_t step = 0; step < steps; ++step) {
    autograd::GradientMap gradients;
    const Tensor logits = run_training(graph, parameters, {images}, {graph.output()}, {.seed = 3, .step = step})[0];
    autograd::backward(ops::softmax_cross_entropy(logits, {0, 1, 2, 3, 0, 1}), gradients);
    optimizer->step(gradients, 1e-2);
    seen.push_back(logits.detached());
    for (const Tensor& w : weights) seen.push_back(gradients.of(w));
  }
  for (const auto& [name, value] : parameters.items()) seen.push_back(value);
  seen.push_back(run_inference(graph, parameters, {images}, {graph.output()})[0]);
  return seen;
}

}  // namespace

TEST_CASE("initialisers and training steps of a network give the same bits for any number of threads") {
  const Graph graph = small_network();
  check_same("network", [&] { return trained(graph, 3); });
}

// Of the step, and not of the weights after it: Adam divides a gradient by its own size, so that rounding decides where
// a gradient is next to nothing.
TEST_CASE("the logits and gradients of a training step agree to 1e-4 on every instruction set") {
  const Graph graph = small_network();
  const std::size_t compared = 1 + trainable(graph, initial_parameters(graph, 7)).size();
  const std::vector<Tensor> best = trained(graph, 1);
  for_instruction_sets([&](const std::string& name) {
    const std::vector<Tensor> capped = trained(graph, 1);
    for (std::size_t i = 0; i < compared; ++i) {
      INFO(name << ", result " << i);
      double largest = 0, apart = 0;
      for (Index j = 0; j < best[i].size(); ++j) {
        const double expected = best[i].data<float>()[j];
        largest = std::max(largest, std::abs(expected));
        apart = std::max(apart, std::abs(expected - static_cast<double>(capped[i].data<float>()[j])));
      }
      REQUIRE(largest > 0);
      CHECK(apart <= 1e-4 * largest);
    }
  });
}
