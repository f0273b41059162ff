// finetune/vgg19/batch:<n>: one training step of VGG19 up to block5_pool: forward pass, backward pass and SGD.
// Counter: `flops` of one step.
#include <benchmark/benchmark.h>

#include "models/registry.h"
#include "nn/autograd.h"
#include "nn/graph/run.h"
#include "nn/ops/losses.h"
#include "nn/optim/optimizer.h"

namespace svnet {
namespace {

void finetune(benchmark::State& state) {
  const Graph graph = models::backbone_kind("vgg19").graph(224, false);
  Parameters parameters = initial_parameters(graph, 1);
  const auto optimizer = sgd(trainable(graph, parameters));
  const Tensor images = initialised(Initializer::lecun_normal, {state.range(0), 224, 224, 3}, 1, 1000);
  const Tensor targets = Tensor::zeros({state.range(0), 7, 7, 512});
  const auto step = [&] {
    const Tensor features = run_training(graph, parameters, {images}, {graph.output()}, {})[0];
    autograd::GradientMap gradients;
    autograd::backward(ops::mean_squared_error(features, targets), gradients);
    optimizer->step(gradients, 1e-6);
  };
  step();  // first use of the memory of activations and gradients
  for (auto _ : state) step();
  double forward = 0, first = 0;  // 2 flops per weight and output position
  for (const GraphNode& node : graph.nodes()) {
    if (node.parameters.empty()) continue;
    const Shape& kernel = node.parameters[0].shape;
    const double flops = 2.0 * static_cast<double>(element_count(kernel) * node.shape[0] * node.shape[1]);
    if (first == 0) first = flops;
    forward += flops;
  }
  state.counters["flops"] = static_cast<double>(state.range(0)) * (3 * forward - first);
}
BENCHMARK(finetune)->Name("finetune/vgg19")->ArgName("batch")->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace svnet
