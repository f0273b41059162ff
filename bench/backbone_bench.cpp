// backbone/<model>/batch:<n>: one inference of a batch up to the pooled output, with seeded random weights.
// backbone/<model>/int8/batch:<n>: the same with products in int8, calibrated on noise.
// SVNET_MAX_ISA limits the instruction set.
// Counters: `flops` and `bytes` of one iteration, as Inference::report counts them.
#include <map>
#include <memory>

#include <benchmark/benchmark.h>

#include "base/cpu.h"
#include "models/backbone.h"

namespace svnet {
using models::Backbone;

namespace {

struct Work {
  double flops = 0, bytes = 0;
};

/// Keeps the last network, because google-benchmark calls a benchmark several times.
const Backbone& network_named(const std::string& name, bool int8) {
  static std::unique_ptr<const Backbone> last;
  static bool last_int8 = false;
  if (last && last->kind().name == name && last_int8 == int8) return *last;
  last_int8 = int8;
  const InferenceOptions options = int8 ? InferenceOptions{} : inference_options_from_environment();
  Backbone backbone = models::random_backbone(name, "", 1, options);
  last = std::make_unique<const Backbone>(int8 ? models::in_int8_for_noise(backbone, 1) : std::move(backbone));
  return *last;
}

/// Counts the work of one iteration; keeps the result for the same reason.
const Work& work_of(const Backbone& network, Index batch) {
  static std::map<std::tuple<std::string, runtime::Precision, Index>, Work> known;
  const auto [at, is_new] = known.try_emplace({network.kind().name, network.network().precision(), batch});
  if (is_new)
    for (const StepReport& step : network.network().report(batch)) {
      at->second.flops += step.flops;
      at->second.bytes += step.bytes;
    }
  return at->second;
}

void backbone(benchmark::State& state, const std::string& name, bool int8) {
  const Backbone& network = network_named(name, int8);
  const auto& input = network.preprocessing();
  const Tensor batch = Tensor::full({state.range(0), input.height, input.width, 3}, 0.25);
  benchmark::DoNotOptimize(network.features(batch));  // first use of the arena
  for (auto _ : state) benchmark::DoNotOptimize(network.features(batch));
  const Work& work = work_of(network, state.range(0));
  state.counters["flops"] = work.flops;
  state.counters["bytes"] = work.bytes;
}

const bool kRegistered = [] {
  cap_from_environment();
  for (const auto& kind : models::backbone_kinds())
    for (const bool int8 : {false, true})
      benchmark::RegisterBenchmark(("backbone/" + kind.name + (int8 ? "/int8" : "")).c_str(), backbone, kind.name, int8)
          ->ArgName("batch")
          ->Arg(1)
          ->Arg(8)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  return true;
}();

}  // namespace
}  // namespace svnet
