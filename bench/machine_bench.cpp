// machine/fma, machine/gemm, machine/memory: the peaks of the machine, in the units of the other benchmarks. Counters:
// `flops` and `bytes` of one iteration.
#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

#include "base/parallel.h"
#include "bench/multiply_adds.h"
#include "nn/kernels/packed/packed_gemm.h"

namespace svnet {
namespace {

/// Multiply-adds in registers on all threads: what no product can exceed, but for Winograd, which needs fewer.
void fma(benchmark::State& state) {
  constexpr Index kRounds = Index{1} << 20;
  Parallel& parallel = Parallel::shared();
  const Index chunks = parallel.threads();
  double flops = 0;
  for (auto _ : state) {
    parallel.for_chunks(chunks, 1, [&](Index, Index, int) { benchmark::DoNotOptimize(bench::multiply_adds(kRounds)); });
    flops = static_cast<double>(chunks) * bench::multiply_add_flops(kRounds);
  }
  state.counters["flops"] = flops;
}
BENCHMARK(fma)->Name("machine/fma")->Unit(benchmark::kMillisecond)->UseRealTime();

/// The packed micro-kernel on all threads; each has its own operands, which stay in its cache.
void gemm(benchmark::State& state) {
  constexpr Index kRows = 84, kDepth = 256, kColumns = 64, kRepeats = 50, kChunksPerThread = 8;
  Parallel& parallel = Parallel::shared();
  struct Operands {
    AlignedFloats a, c;
    kernels::PackedWeights weights;
  };
  std::vector<Operands> operands;
  const std::vector<float> w(static_cast<std::size_t>(kDepth * kColumns), 0.01f);
  for (int worker = 0; worker < parallel.threads(); ++worker) {
    operands.push_back({aligned_floats(kRows * kDepth), aligned_floats(kRows * kColumns),
                        kernels::packed_weights(kDepth, kColumns, w.data(), nullptr)});
    std::fill_n(operands.back().a.get(), kRows * kDepth, 0.01f);
  }
  const Index chunks = parallel.threads() * kChunksPerThread;
  for (auto _ : state)
    parallel.for_chunks(chunks, 1, [&](Index, Index, int worker) {
      const Operands& mine = operands[static_cast<std::size_t>(worker)];
      for (Index i = 0; i < kRepeats; ++i)
        kernels::packed_multiply(kRows, {mine.a.get(), kDepth, kernels::kPanel}, mine.weights, 0,
                                 kernels::panels(kColumns), {}, mine.c.get());
    });
  state.counters["flops"] = 2.0 * static_cast<double>(chunks * kRepeats * kRows * kDepth * kColumns);
}
BENCHMARK(gemm)->Name("machine/gemm")->Unit(benchmark::kMillisecond)->UseRealTime();

/// Reads and writes an array in place that is much larger than any cache.
void memory(benchmark::State& state) {
  constexpr Index kChunk = 65536, kNumbers = Index{1024} * kChunk;
  const AlignedFloats numbers = aligned_floats(kNumbers);
  std::fill_n(numbers.get(), kNumbers, 1.0f);
  float factor = 1.0f;
  benchmark::DoNotOptimize(factor);
  for (auto _ : state) {
    Parallel::shared().for_chunks(kNumbers, kChunk, [&](Index begin, Index, int) {
      float* x = numbers.get() + begin;
      for (Index i = 0; i < kChunk; ++i) x[i] *= factor;
    });
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] = 8.0 * static_cast<double>(kNumbers);
}
BENCHMARK(memory)->Name("machine/memory")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace svnet
