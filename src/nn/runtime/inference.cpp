#include "nn/runtime/inference.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace svnet {
namespace {

/// Where each value lies in the arena, for one sample.
runtime::MemoryPlan planned(const runtime::Program& program) {
  std::vector<runtime::Lifetime> values(program.sizes.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {program.sizes[i], -1, -1};
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const auto& step = program.steps[i];
    auto& written = values[static_cast<std::size_t>(step.output)];
    written.first = written.last = static_cast<int>(i);
    for (const auto id : step.inputs) values[static_cast<std::size_t>(id)].last = static_cast<int>(i);
  }
  // Inputs and output lie in the caller's memory.
  for (std::size_t i = 0; i < program.inputs.size(); ++i) values[i].size = 0;
  values[static_cast<std::size_t>(program.output)].size = 0;
  return runtime::plan_memory(values);
}

/// The number of samples in a group. The activations of a group fit the cache, so that they need not move through
/// memory between steps. But if a step does little work per byte of its weights, reading the weights costs more than
/// that: then the whole batch is one group, so that each step reads its weights once.
Index samples_together(const runtime::Program& program, const runtime::MemoryPlan& memory) {
  constexpr double kLeastFlopsPerByte = 8;
  constexpr Index kMostActivations = Index{2} << 20;  // 8 MiB of floats
  for (const auto& step : program.steps)
    if (step.step->flops() < kLeastFlopsPerByte * step.step->weight_bytes()) return std::numeric_limits<Index>::max();
  return std::max<Index>(kMostActivations / std::max<Index>(memory.size, 1), 1);
}

}  // namespace

/// An arena for one run: a kept one or a new one. Kept for later runs afterwards, if there is a free place.
class Inference::ArenaLease {
 public:
  ArenaLease(const Inference& from, Index size) : from_(from) {
    for (auto& place : from_.free_)
      if (Arena* const kept = place.exchange(nullptr)) {
        arena_.reset(kept);
        break;
      }
    if (!arena_) arena_ = std::make_unique<Arena>();
    from_.reserve(*arena_, size);
  }
  ~ArenaLease() {
    for (auto& place : from_.free_) {
      Arena* none = nullptr;
      if (place.compare_exchange_strong(none, arena_.get())) {
        arena_.release();
        return;
      }
    }
  }
  ArenaLease(const ArenaLease&) = delete;
  ArenaLease& operator=(const ArenaLease&) = delete;
  Arena& operator*() const { return *arena_; }

 private:
  const Inference& from_;
  std::unique_ptr<Arena> arena_{};
};

Inference::Inference(const Graph& graph, const Parameters& parameters, NodeId output, const InferenceOptions& options)
    : options_(options),
      program_(runtime::compile(graph, parameters, output, options)),
      memory_(planned(program_)),
      group_(samples_together(program_, memory_)) {}

Inference::~Inference() {
  for (auto& place : free_) delete place.load();
}

void Inference::reserve(Arena& arena, Index size) const {
  std::size_t most = 1;
  for (const auto& step : program_.steps) most = std::max(most, step.inputs.size());
  arena.inputs.resize(most);
  arena.group_inputs.resize(program_.inputs.size());
  if (arena.size >= size) return;
  arena.size = 0;
  arena.memory.reset();
  arena.memory = aligned_floats(size);
  std::fill_n(arena.memory.get(), size, 0.0f);
  arena.size = size;
}

Index Inference::arena_size(Index batch) const {
  const auto of_group = [&](Index samples) {
    Index scratch = 0;
    for (const auto& step : program_.steps)
      scratch = std::max(scratch, step.step->scratch(samples, Parallel::shared().threads()));
    return memory_.size * samples + scratch;
  };
  if (batch <= group_) return of_group(batch);
  // Fewer samples may need more scratch memory, because the sizes of blocks depend on the number of samples.
  return std::max(of_group(group_), of_group(batch % group_));
}

void Inference::run_step(const runtime::ProgramStep& step, std::span<const float* const> inputs, Index batch,
                         float* output, Arena& arena, const runtime::ProductObserver* observer) const {
  const auto place = [&](runtime::ValueId id) -> float* {
    return id == program_.output ? output : arena.memory.get() + memory_.offsets[static_cast<std::size_t>(id)] * batch;
  };
  for (std::size_t i = 0; i < step.inputs.size(); ++i) {
    const auto id = static_cast<std::size_t>(step.inputs[i]);
    arena.inputs[i] = id < inputs.size() ? inputs[id] : place(step.inputs[i]);
  }
  const runtime::StepBuffers buffers{.inputs = {arena.inputs.data(), step.inputs.size()},
                                     .output = place(step.output),
                                     .scratch = arena.memory.get() + memory_.size * batch,
                                     .batch = batch,
                                     .parallel = Parallel::shared()};
  if (observer != nullptr) step.step->observe(buffers, *observer);
  step.step->run(buffers);
}

void Inference::observe(const std::vector<Tensor>& inputs, const runtime::ProductObserver& observer) const {
  const std::vector<const float*> values = checked(inputs);
  Tensor output = Tensor::empty(program_.output_shape);
  const ArenaLease arena(*this, arena_size(1));
  std::vector<const float*> from(values.size());
  for (Index sample = 0; sample < inputs[0].dim(0); ++sample) {
    for (std::size_t i = 0; i < values.size(); ++i) from[i] = values[i] + sample * program_.sizes[i];
    for (const auto& step : program_.steps) run_step(step, from, 1, output.data<float>(), *arena, &observer);
  }
}

void Inference::run(std::span<const float* const> inputs, Index batch, float* output, Arena* own) const {
  if (own == nullptr) {
    const ArenaLease lease(*this, arena_size(batch));
    return run(inputs, batch, output, &*lease);
  }
  check(inputs.size() == program_.inputs.size(), "[runtime] takes ", program_.inputs.size(), " inputs, got ",
        inputs.size());
  Arena& arena = *own;
  reserve(arena, arena_size(batch));
  std::vector<const float*>& from = arena.group_inputs;
  for (Index begin = 0; begin < batch; begin += group_) {
    for (std::size_t i = 0; i < inputs.size(); ++i) from[i] = inputs[i] + begin * program_.sizes[i];
    const Index group = std::min(group_, batch - begin);
    for (const auto& step : program_.steps)
      run_step(step, from, group, output + begin * element_count(program_.output_shape), arena);
  }
}

std::vector<const float*> Inference::checked(const std::vector<Tensor>& inputs) const {
  check(inputs.size() == program_.inputs.size(), "[runtime] takes ", program_.inputs.size(), " inputs, got ",
        inputs.size());
  check(!inputs.empty() && inputs[0].defined() && inputs[0].rank() >= 1, "[runtime] the first input is empty");
  const Index batch = inputs[0].dim(0);
  std::vector<const float*> values;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    Shape expected = program_.inputs[i];
    expected.insert(expected.begin(), batch);
    check(inputs[i].defined() && inputs[i].shape() == expected, "[runtime] input ", i, " is ",
          inputs[i].defined() ? to_string(inputs[i].shape()) : "empty", ", expected ", to_string(expected));
    values.push_back(inputs[i].data<float>());
  }
  return values;
}

Tensor Inference::run(const std::vector<Tensor>& inputs) const {
  const std::vector<const float*> values = checked(inputs);
  const Index batch = inputs[0].dim(0);
  Shape shape = program_.output_shape;
  shape.insert(shape.begin(), batch);
  Tensor output = Tensor::empty(shape);
  if (batch > 0) run(values, batch, output.data<float>());
  return output;
}

std::vector<std::string> Inference::kernels() const {
  std::vector<std::string> names;
  for (const auto& step : program_.steps) names.push_back(step.step->kernel());
  return names;
}

std::vector<StepReport> Inference::report(Index batch) const {
  using Clock = std::chrono::steady_clock;
  const double groups = static_cast<double>(batch) / static_cast<double>(std::min(batch, group_));
  const double samples = static_cast<double>(batch);
  batch = std::min(batch, group_);
  std::vector<Tensor> zeros;
  std::vector<const float*> inputs;
  for (Shape shape : program_.inputs) {
    shape.insert(shape.begin(), batch);
    zeros.push_back(Tensor::zeros(shape));
    inputs.push_back(zeros.back().data<float>());
  }
  Tensor output = Tensor::empty({batch * element_count(program_.output_shape)});
  std::vector<StepReport> reports;
  for (const auto& step : program_.steps) {
    const auto size = [&](runtime::ValueId id) {
      return static_cast<double>(program_.sizes[static_cast<std::size_t>(id)]);
    };
    double elements = size(step.output);
    for (const auto id : step.inputs) elements += size(id);
    reports.push_back({.layer = step.layer,
                       .kernel = step.step->kernel(),
                       .flops = step.step->flops() * samples,
                       .bytes = 4 * elements * samples + step.step->weight_bytes() * groups,
                       .milliseconds = std::numeric_limits<double>::infinity()});
  }
  const ArenaLease arena(*this, arena_size(batch));
  // At least 200 ms, because the threads of OpenBLAS spin for about 30 ms after the process has started.
  const auto begin = Clock::now();
  for (int repeat = 0; repeat < 5 || Clock::now() - begin < std::chrono::milliseconds(200); ++repeat)
    for (std::size_t i = 0; i < program_.steps.size(); ++i) {
      const auto start = Clock::now();
      run_step(program_.steps[i], inputs, batch, output.data<float>(), *arena);
      reports[i].milliseconds =
          std::min(reports[i].milliseconds, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
  for (auto& report : reports) report.milliseconds *= groups;
  return reports;
}

}  // namespace svnet
