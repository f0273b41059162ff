#include "train/trainer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "nn/graph/run.h"
#include "nn/ops/losses.h"
#include "nn/ops/multiply.h"
#include "train/epoch_order.h"
#include "train/training_step.h"

namespace svnet::train {
using io::Checkpoint;

namespace {

constexpr const char* kMetricsHeader =
    "epoch,step,learning_rate,loss,validation_loss,validation_spearman,validation_regret\n";

/// The sum of all parameters, with their bits read as integers. Different sums mean different parameters.
std::uint64_t sum_of_bits(const Parameters& parameters) {
  std::atomic<std::uint64_t> sum = 0;
  for (const auto& [name, tensor] : parameters.items()) {
    const auto numbers = tensor.values<float>();
    Parallel::shared().for_chunks(static_cast<Index>(numbers.size()), 1 << 16, [&](Index begin, Index end, int) {
      std::uint64_t part = 0;
      for (Index i = begin; i < end; ++i) part += std::bit_cast<std::uint32_t>(numbers[static_cast<std::size_t>(i)]);
      sum += part;
    });
  }
  return sum;
}

using Validation = Trainer::Validation;

std::string metrics_line(Index epoch, Index step, double rate, double loss, const Validation& validation) {
  char text[160];
  std::snprintf(text, sizeof text, "%lld,%lld,%.9g,%.9g,", static_cast<long long>(epoch), static_cast<long long>(step),
                rate, loss);
  std::string line = text;
  if (validation.examples > 0)
    std::snprintf(text, sizeof text, "%.9g,%.9g,%.9g", validation.loss, validation.within_pose.spearman,
                  validation.within_pose.regret);
  return line + (validation.examples > 0 ? text : ",,") + "\n";
}

std::string validation_text(const Validation& validation) {
  if (validation.examples == 0) return "";
  char text[160];
  std::snprintf(text, sizeof text, ", validation loss %.6g, within poses Spearman %.3f, regret %.3f", validation.loss,
                validation.within_pose.spearman, validation.within_pose.regret);
  return text;
}

/// What the epochs are compared by: lower is better.
double judged(double loss, const Validation& validation) {
  if (validation.examples == 0) return loss;
  return validation.within_pose.poses > 0 ? 1 - validation.within_pose.spearman : validation.loss;
}

/// The mean squared error with the weights of the targets.
Tensor weighted_loss(const Tensor& score, const TrainingSet::Batch& batch, bool weighted) {
  if (!weighted) return ops::mean_squared_error(score, batch.targets);
  return ops::mean_squared_error(ops::multiply(score, batch.weights), ops::multiply(batch.targets, batch.weights));
}

}  // namespace

Trainer::Trainer(const Graph& graph, const TrainingSet& training, const TrainingSet* validation,
                 const TrainerOptions& options, Communicator& communicator)
    : graph_(graph), training_(training), validation_(validation), options_(options), communicator_(communicator) {
  check(training_.size() >= 2, "[training] needs at least 2 views with a score, there are ", training_.size());
}

std::unique_ptr<Optimizer> Trainer::new_optimizer(const Parameters& parameters) const {
  return make_optimizer(trainable(graph_, parameters), options_.optimizer);
}

std::vector<Shape> Trainer::optimizer_shapes() const {
  std::vector<Shape> shapes;  // one of each parameter and moment
  for (int moment = 0; moment < moments(options_.optimizer.kind); ++moment)
    for (const auto& node : graph_.nodes())
      for (const auto& spec : node.parameters)
        if (spec.trainable) shapes.push_back(spec.shape);
  return shapes;
}

Index Trainer::steps_per_epoch() const { return batch_count(options_.batch_size, training_.size()); }

double Trainer::step(std::span<const std::int32_t> examples, Parameters& parameters, Optimizer& optimizer) const {
  const auto batch = training_.batch(examples);
  const auto loss = [&](const Tensor& score) { return weighted_loss(score, batch, training_.weighted()); };
  return training_step(graph_, parameters, optimizer, {batch.top_views, batch.angles}, loss,
                       {.task = "training",
                        .learning_rate = options_.schedule.at(optimizer.steps),
                        .seed = options_.seed,
                        .products = autograd::GradientMap::Products::keep,
                        .convolution = options_.convolution,
                        .communicator = &communicator_})
      .loss;
}

Trainer::Validation Trainer::validate(const Parameters& parameters) const {
  if (validation_ == nullptr) return {};
  const TrainingSet& set = *validation_;
  double sum = 0;
  std::vector<double> predicted;
  std::vector<std::int32_t> examples(static_cast<std::size_t>(set.size()));
  std::iota(examples.begin(), examples.end(), 0);
  // Large batches of features, few images: a backbone's activations are up to a hundred times its input.
  const Index most = std::clamp<Index>((Index{1} << 22) / element_count(set.input_shape()), 1, 256);
  for (Index begin = 0; begin < set.size(); begin += most) {
    const auto part = std::span(examples).subspan(static_cast<std::size_t>(begin),
                                                  static_cast<std::size_t>(std::min(most, set.size() - begin)));
    const auto batch = set.batch(part);
    const Tensor score = run_inference(graph_, parameters, {batch.top_views, batch.angles}, {graph_.output()})[0];
    sum += weighted_loss(score, batch, set.weighted()).item() * static_cast<double>(part.size());
    const auto values = score.values<float>();
    predicted.insert(predicted.end(), values.begin(), values.end());
  }
  return {set.size(), sum / static_cast<double>(set.size()), set.within_pose(predicted)};
}

Checkpoint Trainer::initial_state(Parameters parameters) const {
  return {.input_fingerprint = options_.input_fingerprint,
          .metrics = kMetricsHeader,
          .parameters = std::move(parameters),
          .optimizer = {}};
}

double Trainer::finish_epoch(Checkpoint& state, Optimizer& optimizer, const Callbacks& callbacks, Progress& progress,
                             Index& done) const {
  const auto order = epoch_order(training_.size(), options_.seed, state.epoch);
  double sum = std::exchange(state.loss_sum, 0.0);
  const Index finished = std::exchange(state.steps_in_epoch, 0);
  Index steps = 0;
  for (Index begin = 0, end; begin < training_.size(); begin = end) {
    end = batch_end(begin, options_.batch_size, training_.size());
    if (steps++ < finished) continue;
    const auto examples =
        std::span(order).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    sum += step(examples, state.parameters, optimizer) * static_cast<double>(end - begin);
    ++done;
    if (end == training_.size()) break;
    try {
      progress.update(done);
    } catch (...) {
      state.steps = optimizer.steps;
      state.steps_in_epoch = steps;
      state.loss_sum = sum;
      if (callbacks.interrupted) callbacks.interrupted(state);
      throw;
    }
  }
  return sum;
}

void Trainer::train(Checkpoint state, const Callbacks& callbacks, const Messages& messages) {
  const auto optimizer = new_optimizer(state.parameters);
  optimizer->restore(state.optimizer, state.steps);
  state.optimizer = optimizer->state();

  const Index per_epoch = steps_per_epoch();
  check(state.steps_in_epoch >= 0 && state.steps_in_epoch < per_epoch, "[training] the checkpoint has ",
        state.steps_in_epoch, " steps of an epoch that has ", per_epoch);
  Progress progress(messages, "training", (options_.epochs - state.epoch) * per_epoch - state.steps_in_epoch);
  Index done = 0;
  const auto patient = [&] { return options_.patience == 0 || state.epoch - state.best_epoch < options_.patience; };
  while (state.epoch < options_.epochs && patient()) {
    const double rate = options_.schedule.at(optimizer->steps - state.steps_in_epoch);
    const double sum = finish_epoch(state, *optimizer, callbacks, progress, done);
    const double loss = sum / static_cast<double>(training_.size());
    const Validation validation = validate(state.parameters);
    ++state.epoch;
    if (communicator_.size() > 1) {
      const std::uint64_t own = sum_of_bits(state.parameters);
      check(communicator_.broadcast(own) == own, "[training] process ", communicator_.rank(),
            " has other parameters than process 0 after epoch ", state.epoch,
            "; processes must run on processors of one kind, or with SVNET_MAX_ISA set to what all of them have");
    }
    state.steps = optimizer->steps;
    state.metrics += metrics_line(state.epoch, state.steps, rate, loss, validation);
    const bool best = state.epoch == 1 || judged(loss, validation) < state.best_loss;
    if (best) {
      state.best_loss = judged(loss, validation);
      state.best_epoch = state.epoch;
    }
    if (messages.line)
      messages.line(joined("epoch ", state.epoch, "/", options_.epochs, ": loss ", loss, validation_text(validation),
                           best ? ", best so far" : ""));
    callbacks.after_epoch(state, best);
    progress.update(done);
  }
  if (state.epoch < options_.epochs && messages.line)
    messages.line(
        joined("training stops: no better epoch than ", state.best_epoch, " in ", options_.patience, " more"));
}

}  // namespace svnet::train
