// head_step/batch:<n>: one training step of the paper's head (25088 features, width 4096) with Adam.
// Counters: `flops` and the fewest `bytes` of one step.
#include <benchmark/benchmark.h>

#include "models/sv_net.h"
#include "nn/autograd.h"
#include "nn/graph/run.h"
#include "nn/ops/losses.h"
#include "nn/optim/optimizer.h"

namespace svnet {
namespace {

void head_step(benchmark::State& state) {
  const Graph graph = models::sv_net({});
  Parameters parameters = initial_parameters(graph, 1);
  const auto optimizer = adam(trainable(graph, parameters));
  const Tensor features = initialised(Initializer::lecun_normal, {state.range(0), 25088}, 1, 1000);
  const Tensor angles = initialised(Initializer::lecun_normal, {state.range(0), 2}, 1, 1001);
  const Tensor targets = Tensor::full({state.range(0), 1}, 0.5);
  const auto step = [&] {
    const TrainingContext context{.seed = 1, .step = static_cast<std::uint64_t>(optimizer->steps)};
    const Tensor score = run_training(graph, parameters, {features, angles}, {graph.output()}, context)[0];
    autograd::GradientMap gradients(autograd::GradientMap::Products::keep);
    autograd::backward(ops::mean_squared_error(score, targets), gradients);
    optimizer->step(gradients, 1e-3);
  };
  step();  // first use of the optimizer's memory
  for (auto _ : state) step();
  // Every weight is multiplied in the forward pass and for its own gradient; all but those of the first layer also for
  // the gradient of the layer's input. Weights are read in both passes; Adam reads and writes them and both moments.
  const auto weights = static_cast<double>(graph.parameter_count());
  const double backwards = weights - 25088.0 * 4096.0;
  state.counters["flops"] = 2 * static_cast<double>(state.range(0)) * (2 * weights + backwards);
  state.counters["bytes"] = 4 * (7 * weights + backwards);
}
BENCHMARK(head_step)->ArgName("batch")->Arg(32)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace svnet
