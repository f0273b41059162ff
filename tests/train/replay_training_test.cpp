// Replays ten training steps that Keras recorded (tests/oracle/make_training_fixtures.py): from the same initial
// weights and data, every loss must equal Keras'. SVNET_TRAINING_FIXTURES names another folder with such recordings.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>

#include "base/environment.h"
#include "io/tensors/safetensors.h"
#include "models/sv_net.h"
#include "models/trained_graph.h"
#include "nn/autograd.h"
#include "nn/graph/run.h"
#include "nn/ops/losses.h"
#include "nn/optim/optimizer.h"
#include "nn/runtime/inference.h"

namespace svnet {
using namespace io;
using namespace models;

namespace {

constexpr int kSteps = 10;
constexpr double kLossBar = 1e-4;       // relative; float32 on both sides
constexpr double kInferenceBar = 1e-3;  // absolute, of outputs about 1, after ten steps

class Recording {
 public:
  explicit Recording(const std::string& name) : file_(folder() / (name + ".safetensors")) {}

  double learning_rate() const { return std::stod(file_.metadata().at("learning_rate")); }
  std::vector<double> losses(const std::string& prefix) const { return numbers<double>(prefix + "losses", "F64"); }
  const std::vector<Index>& shape(const std::string& name) const { return file_.at(name).shape; }
  Index batches(const std::string& name) const { return shape(name)[0]; }

  Tensor tensor(const std::string& name) const { return Tensor::from(shape(name), numbers<float>(name, "F32")); }

  /// Batch `batch` of a tensor (B, 8, …): F32, or U8 for values from 0 to 1.
  Tensor batch(const std::string& name, Index batch) const {
    std::vector<float> values;
    if (file_.at(name).dtype == "U8")
      for (std::uint8_t value : numbers<std::uint8_t>(name, "U8")) values.push_back(static_cast<float>(value) / 255.0f);
    else
      values = numbers<float>(name, "F32");
    const Shape one(shape(name).begin() + 1, shape(name).end());
    return Tensor::from(one,
                        std::span<const float>(values).subspan(static_cast<std::size_t>(batch * element_count(one)),
                                                               static_cast<std::size_t>(element_count(one))));
  }

  std::vector<Index> classes(Index batch) const {
    const auto all = numbers<std::int64_t>("classes", "I64");
    const auto first = all.begin() + batch * shape("classes")[1];
    return {first, first + shape("classes")[1]};
  }

  Parameters parameters(const Graph& graph) const {
    Parameters parameters;
    for (const auto& node : graph.nodes())
      for (const auto& spec : node.parameters) {
        const Tensor value = tensor("parameters/" + node.parameter_name(spec));
        REQUIRE(value.shape() == spec.shape);
        parameters.set(node.parameter_name(spec), spec.trainable ? value.as_parameter() : value);
      }
    return parameters;
  }

 private:
  static std::filesystem::path folder() {
    const std::string given = environment_variable("SVNET_TRAINING_FIXTURES");
    return !given.empty() ? given : SVNET_SOURCE_DIR "/tests/fixtures/training";
  }

  template <class T>
  std::vector<T> numbers(const std::string& name, const std::string& dtype) const {
    const SafetensorsTensor& stored = file_.at(name);
    REQUIRE(stored.dtype == dtype);
    std::vector<T> values(stored.bytes.size() / sizeof(T));
    std::memcpy(values.data(), stored.bytes.data(), stored.bytes.size());
    return values;
  }

  SafetensorsFile file_;
};

using MakeOptimizer = std::function<std::unique_ptr<Optimizer>(std::vector<Tensor>)>;
using Inputs = std::function<std::vector<Tensor>(Index batch)>;
using Loss = std::function<Tensor(const Tensor& output, Index batch)>;

/// `results`: the prefix of the names of the recorded results.
void replay(const std::string& name, const Recording& recording, const std::string& results, const Graph& graph,
            Parameters parameters, Index batches, const MakeOptimizer& make_optimizer, const Inputs& inputs,
            const Loss& loss) {
  const auto optimizer = make_optimizer(trainable(graph, parameters));
  const std::vector<double> expected = recording.losses(results);
  REQUIRE(expected.size() == kSteps);
  double largest = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Index batch = step % batches;
    const Tensor output = run_training(graph, parameters, inputs(batch), {graph.output()},
                                       {.seed = 0, .step = static_cast<std::uint64_t>(step)})[0];
    const Tensor value = loss(output, batch);
    autograd::GradientMap gradients;
    autograd::backward(value, gradients);
    optimizer->step(gradients, recording.learning_rate());
    const double recorded = expected[static_cast<std::size_t>(step)];
    const double deviation = std::abs(value.item() - recorded) / recorded;
    CAPTURE(step, value.item(), recorded);
    CHECK(deviation < kLossBar);
    largest = std::max(largest, deviation);
  }

  const Tensor found = run_inference(graph, parameters, inputs(0), {graph.output()})[0];
  const Tensor recorded = recording.tensor(results + "inference");
  REQUIRE(found.shape() == recorded.shape());
  double difference = 0;
  for (Index i = 0; i < found.size(); ++i)
    difference =
        std::max(difference, std::abs(static_cast<double>(found.data<float>()[i]) - recorded.data<float>()[i]));
  CHECK(difference < kInferenceBar);
  std::cout << name << ": largest relative deviation of ten losses " << largest
            << ", largest difference of an output after them " << difference << "\n";
}

Graph vgg_like(const Recording& recording) {
  Graph g;
  const auto& images = recording.shape("images");
  NodeId x = g.input("image", {images.begin() + 2, images.end()});
  for (const std::string block : {"block1", "block2", "block3"}) {
    const Index filters = recording.shape("parameters/" + block + "_conv/bias")[0];
    x = g.add(
        block + "_conv",
        Conv2dLayer{.filters = filters, .kh = 3, .kw = 3, .padding = Padding::same(), .activation = Activation::relu},
        {x});
    x = g.add(block + "_pool",
              Pool2dLayer{.kind = PoolKind::max, .window = {.kh = 2, .kw = 2, .stride_h = 2, .stride_w = 2}}, {x});
  }
  x = g.add("flatten", FlattenLayer{}, {x});
  x = g.add("fc", DenseLayer{.units = recording.shape("parameters/fc/bias")[0], .activation = Activation::relu}, {x});
  g.add("logits", DenseLayer{.units = recording.shape("parameters/logits/bias")[0]}, {x});
  return g;
}

TEST_CASE("a VGG-like network trained by SGD with momentum has Keras' losses") {
  const Recording recording("vgg_like");
  const Graph graph = vgg_like(recording);
  replay(
      "vgg_like", recording, "", graph, recording.parameters(graph), recording.batches("images"),
      [](auto parameters) { return sgd(std::move(parameters), {.momentum = 0.9}); },
      [&](Index batch) { return std::vector{recording.batch("images", batch)}; },
      [&](const Tensor& logits, Index batch) { return ops::softmax_cross_entropy(logits, recording.classes(batch)); });
}

TEST_CASE("SV-net trained by Adam has Keras' losses") {
  const Recording recording("sv_net");
  const auto& kernel = recording.shape("parameters/mlp1_1_fc/kernel");
  const Graph graph =
      sv_net({.features = kernel[0], .width = kernel[1], .dropout = 0, .angles = AngleEncoding::radians});
  replay(
      "sv_net", recording, "", graph, recording.parameters(graph), recording.batches("features"),
      [](auto parameters) { return adam(std::move(parameters)); },
      [&](Index batch) {
        return std::vector{recording.batch("features", batch), recording.batch("angles", batch)};
      },
      [&](const Tensor& score, Index batch) {
        return ops::mean_squared_error(score, recording.batch("scores", batch));
      });
}

/// The backbone of make_training_fixtures.py's fine_tuned.
Graph small_backbone(const Recording& recording) {
  Graph g;
  NodeId x = g.input("image", {16, 16, 3});
  for (const std::string block : {"block1", "block2", "block3"}) {
    const Index filters = recording.shape("parameters/" + block + "_conv/bias")[0];
    x = g.add(
        block + "_conv",
        Conv2dLayer{.filters = filters, .kh = 3, .kw = 3, .padding = Padding::same(), .activation = Activation::relu},
        {x});
    x = g.add(block + "_bn", BatchNormLayer{{.momentum = 0.99, .epsilon = 1e-3}}, {x});
    x = g.add(block + "_pool", Pool2dLayer{.window = {.kh = 2, .kw = 2, .stride_h = 2, .stride_w = 2}}, {x});
  }
  return g;
}

TEST_CASE("a backbone trained with its head, whole or by its last block, has Keras' losses") {
  const Recording recording("fine_tuned");
  const Graph backbone = small_backbone(recording);
  const auto& kernel = recording.shape("parameters/mlp1_1_fc/kernel");
  const Graph head =
      sv_net({.features = kernel[0], .width = kernel[1], .dropout = 0, .angles = AngleEncoding::radians});
  const Parameters backbone_parameters = recording.parameters(backbone);
  const auto [results, below] = GENERATE(std::pair<std::string, std::string>{"all/", "image"},
                                         std::pair<std::string, std::string>{"last_block/", "block2_pool"});
  const NodeId from = backbone.find(below);
  const Graph graph = trained_graph(backbone, from, backbone.output(), head);
  Parameters parameters = trained_parameters(graph, backbone_parameters, head, 0);
  const Parameters head_parameters = recording.parameters(head);
  for (const auto& [name, value] : head_parameters.items()) parameters.set("head/" + name, value);
  std::optional<Inference> frozen;
  if (from != backbone.inputs()[0]) frozen.emplace(backbone, backbone_parameters, from);
  replay(
      "fine_tuned " + results, recording, results, graph, parameters, recording.batches("images"),
      [](auto tensors) { return adam(std::move(tensors)); },
      [&](Index batch) {
        const Tensor images = recording.batch("images", batch);
        return std::vector{frozen ? frozen->run({images}) : images, recording.batch("angles", batch)};
      },
      [&](const Tensor& score, Index batch) {
        return ops::mean_squared_error(score, recording.batch("scores", batch));
      });
}

}  // namespace
}  // namespace svnet
