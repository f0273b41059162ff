// finetune/vgg19/batch:<n>: one training step of VGG19 up to block5_pool, forward, backward and SGD.
#include <benchmark/benchmark.h>

#include "models/vgg.h"
#include "nn/autograd.h"
#include "nn/graph/run.h"
#include "nn/ops/losses.h"
#include "nn/optim/optimizer.h"

namespace svnet {
namespace {

void finetune(benchmark::State& state) {
  const Graph graph = models::vgg19(224, false);
  Parameters parameters = initial_parameters(graph, 1);
  const auto optimizer = sgd(trainable(graph, parameters));
  const Tensor images = initialised(Initializer::lecun_normal, {state.range(0), 224, 224, 3}, 1, 1000);
  const Tensor targets = Tensor::zeros({state.range(0), 7, 7, 512});
  for (auto _ : state) {
    const Tensor features = train(graph, parameters, {images}, {graph.output()}, {})[0];
    autograd::GradientMap gradients;
    autograd::backward(ops::mean_squared_error(features, targets), gradients);
    optimizer->step(gradients, 1e-6);
  }
}
BENCHMARK(finetune)->Name("finetune/vgg19")->ArgName("batch")->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace svnet
