// backbone/<model>/batch:<n>: one inference of a whole batch, seeded random weights, to the pooled output.
#include <benchmark/benchmark.h>

#include "models/backbone.h"

namespace svnet {
namespace {

void backbone(benchmark::State& state, const std::string& name) {
  const Backbone network = random_backbone(name, "", 1);
  const auto& input = network.preprocessing();
  const Tensor batch = Tensor::full({state.range(0), input.height, input.width, 3}, 0.25);
  for (auto _ : state) benchmark::DoNotOptimize(network.features(batch));
}

const bool kRegistered = [] {
  for (const auto& kind : backbone_kinds())
    benchmark::RegisterBenchmark(("backbone/" + kind.name).c_str(), backbone, kind.name)
        ->ArgName("batch")
        ->Arg(1)
        ->Arg(8)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  return true;
}();

}  // namespace
}  // namespace svnet
