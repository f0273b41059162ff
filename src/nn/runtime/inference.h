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

/// What one step of a compiled graph does and costs, for reports.
struct StepReport {
  std::string layer, kernel;
  double flops = 0;         ///< of one batch, by the definition of the layer
  double bytes = 0;         ///< of weights, inputs and outputs
  double milliseconds = 0;  ///< shortest of several runs
};

/// A graph compiled for inference: kernels are chosen, batch norms and activations fused, weights laid out for the
/// kernels, memory planned. Inputs and output are f32. It keeps no reference to the graph and the parameters.
/// Several threads may share it. Each run borrows an arena of memory; up to 64 arenas are kept, so that later runs
/// allocate nothing. The bits depend neither on the number of threads nor on the other samples of the batch.
/// A batch is run in groups of samples whose activations fit the cache, unless a layer has much more weights than work
/// per sample.
class Inference {
 public:
  /// Throws Error if parameters are not f32, or the machine lacks the precision.
  Inference(const Graph& graph, const Parameters& parameters, NodeId output, const InferenceOptions& options = {});

  ~Inference();
  Inference(const Inference&) = delete;
  Inference& operator=(const Inference&) = delete;

  const std::vector<Shape>& input_shapes() const { return program_.inputs; }  ///< without the batch
  const Shape& output_shape() const { return program_.output_shape; }         ///< without the batch

  const InferenceOptions& options() const { return options_; }
  runtime::Precision precision() const { return options_.precision; }

  /// The output of a batch. Inputs are f32, in the graph's order. Throws Error if shapes do not fit.
  Tensor run(const std::vector<Tensor>& inputs) const;

  /// Runs a batch and shows the left operand of each product that int8 can multiply, as runtime::ProductObserver says.
  /// Requires InferenceOptions::observable.
  void observe(const std::vector<Tensor>& inputs, const runtime::ProductObserver& observer) const;

  /// The memory of runs, one at a time. It grows to what a run needs, and later runs allocate nothing.
  struct Arena {
    AlignedFloats memory{};
    Index size = 0;
    std::vector<const float*> inputs{}, group_inputs{};  // of the current step, of the graph
  };
  /// The same from and into the caller's memory. Requires that 64 bytes after the end of each input can be read.
  /// `arena`: the caller's own, used with this network only; nullptr: a borrowed one.
  void run(std::span<const float* const> inputs, Index batch, float* output, Arena* arena = nullptr) const;

  /// Number of floats of activations and scratch memory that a batch needs.
  Index arena_size(Index batch) const;
  /// The kernel of each step, as StepReport names it.
  std::vector<std::string> kernels() const;
  /// Every step with its time on zeros: the time of one group times the number of groups of a batch.
  std::vector<StepReport> report(Index batch) const;

 private:
  static constexpr std::size_t kKeptArenas = 64;
  class ArenaLease;

  void reserve(Arena& arena, Index size) const;
  void run_step(const runtime::ProgramStep& step, std::span<const float* const> inputs, Index batch, float* output,
                Arena& arena, const runtime::ProductObserver* observer = nullptr) const;
  /// The elements of the inputs. Throws Error if shapes do not fit.
  std::vector<const float*> checked(const std::vector<Tensor>& inputs) const;

  InferenceOptions options_;
  runtime::Program program_;
  runtime::MemoryPlan memory_;
  Index group_;
  // Arenas that no run uses. Without a lock: fork() could copy it while another thread holds it.
  mutable std::array<std::atomic<Arena*>, kKeptArenas> free_{};
};

}  // namespace svnet
