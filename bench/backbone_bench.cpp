// backbone/<model>/batch:<n>: one inference of a batch up to the pooled output, with seeded random weights.
// Counters: `flops` and `bytes` of one iteration, as Inference::report counts them.
#include <map>
#include <memory>

#include <benchmark/benchmark.h>

#include "models/backbone.h"

namespace svnet {
using models::Backbone;

namespace {

struct Work {
  double flops = 0, bytes = 0;
};

/// Keeps the last network, because google-benchmark calls a benchmark several times.
const Backbone& network_named(const std::string& name) {
  static std::unique_ptr<const Backbone> last;
  if (!last || last->kind().name != name)
    last = std::make_unique<const Backbone>(models::random_backbone(name, "", 1, inference_options_from_environment()));
  return *last;
}

/// Counts the work of one iteration; keeps the result for the same reason.
const Work& work_of(const Backbone& network, Index batch) {
  static std::map<std::pair<std::string, Index>, Work> known;
  const auto [at, is_new] = known.try_emplace({network.kind().name, batch});
  if (is_new)
    for (const StepReport& step : network.network().report(batch)) {
      at->second.flops += step.flops;
      at->second.bytes += step.bytes;
    }
  return at->second;
}

void backbone(benchmark::State& state, const std::string& name) {
  const Backbone& network = network_named(name);
  const auto& input = network.preprocessing();
  const Tensor batch = Tensor::full({state.range(0), input.height, input.width, 3}, 0.25);
  benchmark::DoNotOptimize(network.features(batch));  // first use of the arena
  for (auto _ : state) benchmark::DoNotOptimize(network.features(batch));
  const Work& work = work_of(network, state.range(0));
  state.counters["flops"] = work.flops;
  state.counters["bytes"] = work.bytes;
}

const bool kRegistered = [] {
  for (const auto& kind : models::backbone_kinds())
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
