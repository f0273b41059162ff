#include "nn/runtime/calibration.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/instruction_sets.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// A first layer, a separable block with a pool and a shortcut, an expanded block, a plain 3x3 and a dense layer.
Graph small_network() {
  Graph g;
  NodeId x = g.add("stem", Conv2dLayer{.filters = 20, .kh = 3, .kw = 3, .activation = Activation::relu},
                   {g.input("image", {16, 14, 3})});
  const NodeId shortcut = g.add("shortcut", Conv2dLayer{.filters = 36, .stride_h = 2, .stride_w = 2}, {x});
  x = g.add("separable", SeparableConv2dLayer{.filters = 36, .kh = 3, .kw = 3, .padding = Padding::same()}, {x});
  x = g.add("pool", Pool2dLayer{.window = {.kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2, .padding = Padding::same()}},
            {x});
  x = g.add("sum", AddLayer{}, {x, shortcut});
  x = g.add("expand", Conv2dLayer{.filters = 48, .activation = Activation::relu6}, {x});
  x = g.add("depthwise",
            DepthwiseConv2dLayer{.kh = 3, .kw = 3, .padding = Padding::same(), .activation = Activation::relu6}, {x});
  x = g.add("project", Conv2dLayer{.filters = 33}, {x});
  x = g.add("wide", Conv2dLayer{.filters = 20, .kh = 3, .kw = 3, .stride_h = 2, .stride_w = 2}, {x});
  x = g.add("pooled", GlobalPool2dLayer{.kind = PoolKind::average}, {x});
  g.add("dense", DenseLayer{.units = 7}, {x});
  return g;
}

Tensor pictures(std::uint32_t seed, Index count = 3) { return random_tensor({count, 16, 14, 3}, seed, DType::f32); }

ActivationRanges ranges_over(const Graph& graph, const Parameters& parameters, const Tensor& batch) {
  Calibration calibration(graph, parameters, graph.output());
  calibration.add(batch);
  return calibration.ranges();
}

}  // namespace

TEST_CASE("calibration sees what every product in int8 reads") {
  const Graph graph = small_network();
  const Parameters parameters = initial_parameters(graph, 3);
  const Tensor batch = pictures(1);
  const ActivationRanges ranges = ranges_over(graph, parameters, batch);
  std::vector<std::string> layers;
  for (const auto& [layer, of_layer] : ranges) layers.push_back(layer);
  CHECK(layers == std::vector<std::string>{"expand", "project", "separable", "shortcut", "wide"});
  // The shortcut reads the output of the stem.
  const Tensor stem = Inference(graph, parameters, graph.find("stem")).run({batch});
  const kernels::ChannelRanges& seen = ranges.at("shortcut");
  REQUIRE(seen.high.size() == 20);
  for (Index channel = 0; channel < 20; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    float high = 0;
    double sum = 0;
    for (Index i = channel; i < stem.size(); i += 20) {
      high = std::max(high, stem.data<float>()[i]);
      sum += stem.data<float>()[i];
    }
    CHECK(seen.low[c] == 0);
    CHECK(seen.high[c] == Approx(high).epsilon(1e-5));
    CHECK(seen.mean[c] == Approx(sum * 20 / static_cast<double>(stem.size())).epsilon(1e-5));
  }
  CHECK(*std::max_element(ranges.at("project").high.begin(), ranges.at("project").high.end()) <= 6);
  CHECK(*std::min_element(ranges.at("separable").low.begin(), ranges.at("separable").low.end()) < 0);
}

TEST_CASE("ranges have the same bits for any number of threads, and their fingerprint changes with each number") {
  const Graph graph = small_network();
  const Parameters parameters = initial_parameters(graph, 3);
  const int threads = Parallel::shared().threads();
  ActivationRanges first = ranges_over(graph, parameters, pictures(1));
  for (const int count : {1, 2, 8}) {
    Parallel::shared().resize(count);
    CHECK(ranges_over(graph, parameters, pictures(1)) == first);
  }
  Parallel::shared().resize(threads);
  const std::string before = fingerprint(first);
  CHECK(before == fingerprint(ranges_over(graph, parameters, pictures(1))));
  for (float* value : {&first.at("expand").low[5], &first.at("wide").high[0], &first.at("project").mean[7]}) {
    const float kept = *value;
    *value = std::nextafter(*value, 100.0f);
    CHECK(fingerprint(first) != before);
    *value = kept;
  }
  CHECK(fingerprint(first) == before);
}

TEST_CASE("in int8 a compiled graph is near that in f32, with the same bits for any batch and number of threads") {
  const Graph graph = small_network();
  const Parameters parameters = initial_parameters(graph, 3);
  const Tensor batch = pictures(1, 5);
  const auto ranges = std::make_shared<ActivationRanges>(ranges_over(graph, parameters, batch));
  const InferenceOptions options{.precision = kernels::Precision::int8, .ranges = ranges};
  const Inference exact(graph, parameters, graph.output()), coarse(graph, parameters, graph.output(), options);
  int in_int8 = 0;
  for (const std::string& kernel : coarse.kernels()) in_int8 += kernel.find("int8") != std::string::npos;
  CHECK(in_int8 >= 4);
  const int threads = Parallel::shared().threads();
  const Tensor first = coarse.run({batch});
  for (const int count : {1, 2, 8}) {
    Parallel::shared().resize(count);
    CHECK(same_bits(coarse.run({batch}), first));
  }
  Parallel::shared().resize(threads);
  const double apart = relative_distance(first, exact.run({batch}));
  CHECK(apart > 0);
  CHECK(apart <= 0.05);
  Tensor image = Tensor::empty({1, 16, 14, 3});
  std::copy_n(batch.data<float>() + image.size(), image.size(), image.data<float>());
  const Tensor alone = coarse.run({image});
  CHECK(std::equal(alone.data<float>(), alone.data<float>() + alone.size(), first.data<float>() + alone.size()));
  // AVX-512 with and without VNNI and AVX2 fuse the same products and sums of the f32 steps, and int8 is exact.
  for_instruction_sets([&](const std::string& name) {
    INFO(name);
    const Tensor here = coarse.run({batch});
    if (name.starts_with("AVX"))
      CHECK(same_bits(here, first));
    else
      CHECK(relative_distance(here, first) <= 0.02);
  });
}

TEST_CASE("calibration refuses no pictures and values that are not finite; int8 refuses ranges that do not fit") {
  const Graph graph = small_network();
  const Parameters parameters = initial_parameters(graph, 3);
  Calibration calibration(graph, parameters, graph.output());
  CHECK_THROWS_WITH(calibration.ranges(), Catch::Contains("[calibration] there are no pictures"));
  CHECK_THROWS_WITH(calibration.add({}), Catch::Contains("[calibration] there are no pictures"));
  CHECK_THROWS_WITH(calibration.add(Tensor::empty({0, 16, 14, 3})), Catch::Contains("there are no pictures"));
  Tensor bad = pictures(1);
  bad.data<float>()[77] = INFINITY;
  CHECK_THROWS_WITH(calibration.add(bad), Catch::Contains("a picture has values that are not finite"));
  for (const float value : {INFINITY, std::nanf("")}) {
    Parameters broken = initial_parameters(graph, 3);
    Tensor kernel = broken.at("project/kernel").clone();
    kernel.data<float>()[3] = value;
    broken.set("project/kernel", kernel);
    CHECK_THROWS_WITH(ranges_over(graph, broken, pictures(1)), Catch::Contains("is not finite"));
  }
  const auto compiled = [&](std::shared_ptr<const ActivationRanges> ranges) {
    return Inference(graph, parameters, graph.output(),
                     {.precision = kernels::Precision::int8, .ranges = std::move(ranges)});
  };
  CHECK_THROWS_WITH(compiled(nullptr), Catch::Contains("[precision] int8 needs the ranges of activations"));
  auto ranges = ranges_over(graph, parameters, pictures(1));
  ranges.at("wide").low.pop_back();
  CHECK_THROWS_WITH(compiled(std::make_shared<ActivationRanges>(ranges)), Catch::Contains("layer wide multiplies 33"));
  ranges.erase("wide");
  CHECK_THROWS_WITH(compiled(std::make_shared<ActivationRanges>(ranges)), Catch::Contains("lack layer wide"));
}
