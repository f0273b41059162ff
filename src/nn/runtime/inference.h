#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "base/aligned.h"
#include "base/parallel.h"
#include "nn/runtime/compile.h"
#include "nn/runtime/memory_plan.h"

namespace svnet {

/// What one step of a compiled graph is, for people.
struct StepReport {
  std::string layer, kernel;
  double flops = 0;         ///< of one batch, as the layer defines them
  double bytes = 0;         ///< of weights read, inputs and outputs
  double milliseconds = 0;  ///< the fastest of several runs
};

/// A graph compiled for inference, f32 in and out: kernels chosen, batch norms and activations fused, weights laid out
/// for the kernels, memory planned. It keeps no reference to graph and parameters. Safe to share between threads: each
/// run borrows an arena, and nothing is allocated once there are as many as runs at once, up to 64. The same bits for
/// any number of threads; a sample's result does not depend on the others of its batch. A batch goes through all steps
/// in groups of samples whose activations stay in cache, unless some layer reads its weights for little work a sample.
class Inference {
 public:
  /// With the kernels and the precision that the environment asks for. Throws Error for parameters that are not f32.
  Inference(const Graph& graph, const Parameters& parameters, NodeId output);
  Inference(const Graph& graph, const Parameters& parameters, NodeId output, runtime::Convolution convolution,
            runtime::Precision precision = runtime::Precision::f32);

  ~Inference();
  Inference(const Inference&) = delete;
  Inference& operator=(const Inference&) = delete;

  const std::vector<Shape>& input_shapes() const { return program_.inputs; }  ///< without the batch
  const Shape& output_shape() const { return program_.output_shape; }         ///< without the batch

  runtime::Precision precision() const { return precision_; }

  /// The output of a batch; inputs in the graph's order, f32. Throws Error where shapes do not fit.
  Tensor run(const std::vector<Tensor>& inputs) const;
  /// The same from and into the caller's memory; inputs may be read up to 64 bytes past their end.
  void run(std::span<const float* const> inputs, Index batch, float* output) const;

  /// Numbers of activations and scratch memory that a batch needs.
  Index arena_size(Index batch) const;
  /// Every step, timed on zeros: what it takes for one group, times the groups of a batch.
  std::vector<StepReport> report(Index batch) const;

 private:
  static constexpr std::size_t kKeptArenas = 64;
  struct Arena {
    AlignedFloats memory{};
    Index size = 0;
    std::vector<const float*> inputs{}, group_inputs{};  // of a step, of the graph
  };
  class ArenaLease;

  void run_step(const runtime::ProgramStep& step, std::span<const float* const> inputs, Index batch, float* output,
                Arena& arena) const;

  runtime::Precision precision_;
  runtime::Program program_;
  runtime::MemoryPlan memory_;
  Index group_;
  // Without a lock, which fork() would copy while another thread holds it.
  mutable std::array<std::atomic<Arena*>, kKeptArenas> free_{};
};

}  // namespace svnet
