#include "nn/runtime/inference.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "base/instruction_sets.h"
#include "base/random.h"
#include "nn/graph/run.h"
#include "nn/kernels/packed/bf16_tile.h"
#include "nn/numbers.h"
#include "nn/ops/conv2d.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// Parameters whose biases, means and variances are not trivial.
Parameters drawn(const Graph& graph) {
  Parameters parameters = initial_parameters(graph, 3);
  std::uint64_t seed = 100;
  for (const auto& node : graph.nodes())
    for (const auto& spec : node.parameters)
      if (spec.shape.size() == 1)
        parameters.set(node.parameter_name(spec), random_tensor(spec.shape, ++seed, DType::f32, 0.5, 1.5));
  return parameters;
}

const Tensor kImages = random_tensor({3, 12, 10, 5}, 1, DType::f32);

/// Every kind of layer, with every fusion that is possible and some that are not.
Graph all_layers() {
  Graph g;
  const Padding same = Padding::same();
  const NodeId image = g.input("image", {12, 10, 5});
  NodeId x = g.add("pad", ZeroPadding2dLayer{Padding::of(1, 2, 0, 1)}, {image});
  x = g.add("conv", Conv2dLayer{.filters = 32, .kh = 3, .kw = 3, .activation = Activation::relu}, {x});
  const NodeId trunk = x = g.add("winograd", Conv2dLayer{.filters = 32, .kh = 3, .kw = 3, .padding = same}, {x});
  const NodeId act = g.add("act", ActivationLayer{Activation::relu}, {x});
  x = g.add("separable", SeparableConv2dLayer{.filters = 32, .kh = 3, .kw = 3, .padding = same}, {act});
  x = g.add("norm", BatchNormLayer{}, {x});
  x = g.add("sum", AddLayer{}, {x, trunk});  // trunk has two readers, so nothing may be applied to it in place
  x = g.add("sum_act", ActivationLayer{Activation::relu}, {x});
  const NodeId before = x = g.add("after_sum", SeparableConv2dLayer{.filters = 24, .kh = 3, .kw = 3}, {x});
  x = g.add("expand", Conv2dLayer{.filters = 40, .bias = false}, {x});
  x = g.add("expand_bn", BatchNormLayer{}, {x});
  x = g.add("expand_act", ActivationLayer{Activation::relu6}, {x});
  x = g.add("stride_pad", ZeroPadding2dLayer{Padding::of(1, 1, 1, 1)}, {x});
  x = g.add("depthwise", DepthwiseConv2dLayer{.kh = 3, .kw = 3, .activation = Activation::relu6}, {x});
  x = g.add("project", Conv2dLayer{.filters = 24}, {x});
  x = g.add("shortcut", AddLayer{}, {before, x});
  x = g.add("lonely_depthwise",
            DepthwiseConv2dLayer{.kh = 2, .kw = 2, .multiplier = 2, .activation = Activation::sigmoid}, {x});
  x = g.add("doubled", SeparableConv2dLayer{.filters = 32, .kh = 3, .kw = 3, .multiplier = 2, .padding = same}, {x});
  x = g.add(
      "free_norm", BatchNormLayer{},
      {g.add("average", Pool2dLayer{.kind = PoolKind::average, .window = {.kh = 2, .kw = 2, .padding = same}}, {x})});
  x = g.add("pooled", Conv2dLayer{.filters = 16, .kh = 3, .kw = 3, .padding = same, .activation = Activation::relu},
            {x});
  x = g.add("pool", Pool2dLayer{.window = {.kh = 2, .kw = 2, .stride_h = 2, .stride_w = 2}}, {x});
  const NodeId mean = g.add("mean", GlobalPool2dLayer{.kind = PoolKind::average, .keep_dimensions = true}, {x});
  const NodeId most = g.add("most", GlobalPool2dLayer{.kind = PoolKind::max}, {x});
  const NodeId flat = g.add("flat", FlattenLayer{}, {mean});
  x = g.add("join", ConcatLayer{}, {flat, most, flat});
  x = g.add("drop", DropoutLayer{.rate = 0.5}, {x});
  x = g.add("dense", DenseLayer{.units = 9, .activation = Activation::sigmoid}, {x});
  x = g.add("flat_again", FlattenLayer{}, {g.add("shape", ReshapeLayer{{3, 3}}, {x})});
  g.add("chances", DenseLayer{.units = 4, .activation = Activation::softmax}, {x});
  return g;
}

}  // namespace

TEST_CASE("a batch that runs in groups gives the results of single samples") {
  const Graph graph = all_layers();
  for (const char* name : {"after_sum", "average"}) {  // before dense layers, which take the whole batch
    const Inference inference(graph, drawn(graph), graph.find(name));
    REQUIRE(inference.arena_size(10000) == inference.arena_size(20000));
    Index batch = 1;
    while (inference.arena_size(batch) < inference.arena_size(10000)) ++batch;  // the size of a group
    batch += batch / 2;
    Shape shape = inference.input_shapes()[0];
    shape.insert(shape.begin(), batch);
    const Tensor images = random_tensor(shape, 7, DType::f32);
    const Tensor together = inference.run({images});
    const Index in = images.size() / batch, out = together.size() / batch;
    for (Index i = 0; i < batch; ++i) {
      Tensor image = Tensor::empty({1, shape[1], shape[2], shape[3]});
      std::copy_n(images.data<float>() + i * in, in, image.data<float>());
      const Tensor alone = inference.run({image});
      REQUIRE(std::equal(alone.data<float>(), alone.data<float>() + out, together.data<float>() + i * out));
    }
  }
  const Inference dense(graph, drawn(graph), graph.output());
  CHECK(dense.arena_size(2000) > dense.arena_size(1000));
}

TEST_CASE("an arena is large enough for the last group, which may need more scratch memory than a full one") {
  Graph graph;
  NodeId x = graph.input("image", {12, 12, 480});
  for (const char* name : {"a", "b", "c"})
    x = graph.add(name, Conv2dLayer{.filters = 480, .kh = 3, .kw = 3, .padding = Padding::same()}, {x});
  const Inference inference(graph, drawn(graph), x);
  for (Index batch = 16; batch < 60; ++batch) {
    INFO(batch);
    for (Index last = 1; last < 15 && last < batch; ++last)
      if ((batch - last) % 15 == 0) CHECK(inference.arena_size(batch) >= inference.arena_size(last));
  }
  CHECK(inference.arena_size(29) > inference.arena_size(15));  // 14 samples are cut into larger blocks
}

TEST_CASE("a compiled graph computes its layers, for any output layer") {
  const Graph graph = all_layers();
  const Parameters parameters = drawn(graph);
  for (const auto convolution :
       {runtime::Convolution::automatic, runtime::Convolution::direct, runtime::Convolution::winograd})
    for (NodeId output = 0; output <= graph.output(); ++output) {
      INFO("output " << graph.node(output).name << ", convolution " << static_cast<int>(convolution));
      const Inference compiled(graph, parameters, output, {.convolution = convolution});
      CHECK(relative_distance(compiled.run({kImages}), run_inference(graph, parameters, {kImages}, {output})[0]) <=
            5e-6);
    }
}

namespace {

/// Blocks with squeeze and excitation, as in MobileNetV3: hard activations and products of all shapes.
Graph squeeze_and_excite() {
  Graph g;
  const NodeId image = g.input("image", {12, 10, 5});
  NodeId x = g.add("conv", Conv2dLayer{.filters = 19, .kh = 3, .kw = 3, .bias = false}, {image});
  x = g.add("norm", BatchNormLayer{}, {x});
  const NodeId y = x = g.add("swish", ActivationLayer{Activation::hard_swish}, {x});
  x = g.add("squeeze", GlobalPool2dLayer{.keep_dimensions = true}, {x});
  x = g.add("reduce", Conv2dLayer{.filters = 8, .activation = Activation::relu}, {x});
  x = g.add("excite", Conv2dLayer{.filters = 19, .activation = Activation::hard_sigmoid}, {x});
  x = g.add("scaled", MultiplyLayer{}, {y, x});
  const NodeId flat = g.add("flat_squeeze", GlobalPool2dLayer{}, {x});
  x = g.add("factor_first", MultiplyLayer{}, {flat, x});
  x = g.add("square", MultiplyLayer{}, {x, x});
  x = g.add("relu6", ActivationLayer{Activation::relu6}, {x});
  x = g.add("pool", GlobalPool2dLayer{}, {x});
  g.add("gated", MultiplyLayer{}, {x, flat});
  return g;
}

}  // namespace

TEST_CASE("compiled squeeze and excitation computes its layers, for any output layer") {
  const Graph graph = squeeze_and_excite();
  const Parameters parameters = drawn(graph);
  for (NodeId output = 1; output <= graph.output(); ++output) {
    INFO("output " << graph.node(output).name);
    const Tensor expected = run_inference(graph, parameters, {kImages}, {output})[0];
    const Tensor actual = Inference(graph, parameters, output).run({kImages});
    CHECK(actual.shape() == expected.shape());
    CHECK(relative_distance(actual, expected) <= 5e-6);
  }
}

TEST_CASE("compiling fuses layers that have one reader") {
  const Graph graph = all_layers();
  const auto program = runtime::compile(graph, drawn(graph), graph.output(), {});
  std::vector<std::string> layers;
  for (const auto& step : program.steps) layers.push_back(step.layer);
  CHECK(layers == std::vector<std::string>{"conv",
                                           "winograd",
                                           "sum_act",
                                           "after_sum",
                                           "expand_act",
                                           "shortcut",
                                           "lonely_depthwise",
                                           "lonely_depthwise",
                                           "doubled",
                                           "doubled",
                                           "average",
                                           "free_norm",
                                           "pool",
                                           "mean",
                                           "most",
                                           "join",
                                           "dense",
                                           "dense",
                                           "chances",
                                           "chances"});
}

TEST_CASE("a sample's bits depend neither on its batch nor on the number of threads nor on what ran before") {
  const Graph graph = all_layers();
  const Inference compiled(graph, drawn(graph), graph.find("join"));
  const Index sample = kImages.size() / kImages.dim(0);
  const int threads = Parallel::shared().threads();
  std::vector<Tensor> seen;
  for (int count : {1, 2, 8}) {
    Parallel::shared().resize(count);
    seen.push_back(compiled.run({kImages}));
    CHECK(same_bits(seen.front(), seen.back()));
  }
  Parallel::shared().resize(threads);
  const Index width = seen[0].dim(1);
  for (Index i = 0; i < kImages.dim(0); ++i) {
    Tensor one = Tensor::empty({1, 12, 10, 5});
    std::copy_n(kImages.data<float>() + i * sample, sample, one.data<float>());
    const Tensor alone = compiled.run({one});
    CHECK(std::equal(alone.data<float>(), alone.data<float>() + width, seen[0].data<float>() + i * width));
  }
}

TEST_CASE("several threads may run one compiled graph") {
  const Graph graph = all_layers();
  const Inference compiled(graph, drawn(graph), graph.output());
  const Tensor expected = compiled.run({kImages});
  std::vector<Tensor> results(4);
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (Tensor& result : results)
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) result = compiled.run({kImages});
    });
  for (auto& thread : threads) thread.join();
  for (const Tensor& result : results) CHECK(same_bits(result, expected));
}

TEST_CASE("an option forces a kind of convolution in training, too") {
  const Tensor x = random_tensor({1, 8, 8, 16}, 1, DType::f32), w = random_tensor({3, 3, 16, 16}, 2, DType::f32);
  const auto trained = [&](kernels::Convolution convolution) {
    return ops::conv2d(x, w, {.convolution = convolution});
  };
  CHECK_FALSE(same_bits(trained(kernels::Convolution::direct), trained(kernels::Convolution::winograd)));
  CHECK(same_bits(trained(kernels::Convolution::automatic), trained(kernels::Convolution::winograd)));

  Graph graph;
  graph.add("conv", Conv2dLayer{.filters = 16, .kh = 3, .kw = 3}, {graph.input("image", {8, 8, 16})});
  Parameters parameters = initial_parameters(graph, 1);
  const auto step = [&](kernels::Convolution convolution) {
    return run_training(graph, parameters, {x}, {graph.output()}, {.convolution = convolution})[0];
  };
  CHECK_FALSE(same_bits(step(kernels::Convolution::direct), step(kernels::Convolution::winograd)));
}

TEST_CASE("in bf16 a compiled graph is near that in f32, with the same bits for any batch and number of threads") {
  if (!kernels::machine_has_bf16()) {
    WARN("this processor has no AVX512-BF16: nothing is tested");
    return;
  }
  const Graph graph = all_layers();
  const Parameters parameters = drawn(graph);
  const int threads = Parallel::shared().threads();
  for (const char* name :
       {"conv", "sum_act", "after_sum", "expand", "shortcut", "doubled", "join", "dense", "chances"}) {
    INFO(name);
    const auto compiled = [&](runtime::Precision precision) {
      return Inference(graph, parameters, graph.find(name), {.precision = precision});
    };
    const Inference coarse = compiled(runtime::Precision::bf16);
    Tensor first;
    for (int count : {1, 2, 8}) {
      Parallel::shared().resize(count);
      const Tensor result = coarse.run({kImages});
      if (!first.defined()) first = result;
      CHECK(same_bits(result, first));
    }
    Parallel::shared().resize(threads);
    const double apart = relative_distance(first, compiled(runtime::Precision::f32).run({kImages}));
    CHECK(apart <= 1e-2);
    CHECK((apart > 0) == (std::string(name) != "conv"));  // first layers are f32
    Tensor image = Tensor::empty({1, 12, 10, 5});
    std::copy_n(kImages.data<float>() + image.size(), image.size(), image.data<float>());
    const Tensor alone = coarse.run({image});
    CHECK(std::equal(alone.data<float>(), alone.data<float>() + alone.size(), first.data<float>() + alone.size()));
  }
}

TEST_CASE("an option chooses bf16 if the machine has it") {
  const Graph graph = all_layers();
  const auto made = [&](const InferenceOptions& options) {
    return Inference(graph, drawn(graph), graph.output(), options);
  };
  const InferenceOptions bf16{.precision = runtime::Precision::bf16};
  for (const InferenceOptions& options : {InferenceOptions{}, InferenceOptions{.precision = runtime::Precision::f32}}) {
    const Inference plain = made(options);
    CHECK(plain.precision() == runtime::Precision::f32);
    for (const StepReport& step : plain.report(1)) CHECK(step.kernel.find("bf16") == std::string::npos);
  }
  if (kernels::machine_has_bf16()) {
    std::vector<std::string> kernels;
    for (const StepReport& step : made(bf16).report(1)) kernels.push_back(step.kernel);
    for (const char* kernel : {"bf16 gemm 1x1", "depthwise 3x3 + bf16 gemm", "winograd 3x3", "implicit gemm 3x3"})
      CHECK(std::count(kernels.begin(), kernels.end(), kernel) > 0);
    const bool may_be_capped = instruction_sets().front().starts_with("AVX3");  // unless kernels have AVX2 alone
    for_instruction_sets([&](const std::string& name) {
      if (may_be_capped && !name.starts_with("AVX3"))
        CHECK_THROWS_WITH(made(bf16), Catch::Contains("bf16 needs AVX-512, but kernels are capped at " + name));
    });
  } else {
    CHECK_THROWS_WITH(made(bf16), Catch::Contains("bf16 needs a processor with AVX512-BF16"));
  }
}

TEST_CASE("a compiled graph says what is wrong with its inputs") {
  const Graph graph = all_layers();
  const Inference compiled(graph, drawn(graph), graph.output());
  CHECK_THROWS_WITH(compiled.run(std::vector<Tensor>{}), "[runtime] takes 1 inputs, got 0");
  CHECK_THROWS_WITH(compiled.run({Tensor::zeros({2, 12, 11, 5})}),
                    "[runtime] input 0 is 2x12x11x5, expected 2x12x10x5");
  CHECK_THROWS_WITH(Inference(graph, initial_parameters(graph, 1, DType::f64), graph.output()), Catch::Contains("f32"));
  CHECK(compiled.run({Tensor::zeros({0, 12, 10, 5})}).shape() == Shape{0, 4});
}

TEST_CASE("values of a plan never share memory while both are in use") {
  RandomStream random(4, Stream::weights);
  std::vector<runtime::Lifetime> values(60);
  for (auto& value : values) {
    value.size = static_cast<Index>(random.uniform() * 1000);
    value.first = static_cast<int>(random.uniform() * 40);
    value.last = value.first + static_cast<int>(random.uniform() * 6);
  }
  const runtime::MemoryPlan plan = runtime::plan_memory(values);
  Index most = 0;
  for (int step = 0; step < 50; ++step) {
    Index live = 0;
    for (const auto& value : values)
      if (value.first <= step && step <= value.last) live += (value.size + 15) / 16 * 16;
    most = std::max(most, live);
  }
  CHECK(plan.size >= most);
  CHECK(plan.size <= 2 * most);
  for (std::size_t i = 0; i < values.size(); ++i) {
    CHECK(plan.offsets[i] % 16 == 0);
    CHECK(plan.offsets[i] + values[i].size <= plan.size);
    for (std::size_t j = 0; j < i; ++j) {
      const bool together = values[i].first <= values[j].last && values[j].first <= values[i].last;
      const bool apart =
          plan.offsets[i] + values[i].size <= plan.offsets[j] || plan.offsets[j] + values[j].size <= plan.offsets[i];
      if (together && values[i].size > 0 && values[j].size > 0) CHECK(apart);
    }
  }
}
