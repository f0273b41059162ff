#pragma once
#include <functional>
#include <string>

#include "base/communicator.h"
#include "base/progress.h"
#include "io/models/checkpoint.h"
#include "nn/optim/optimizer.h"
#include "nn/optim/schedule.h"
#include "train/training_set.h"

namespace svnet {

struct TrainerOptions {
  Index epochs = 10;
  Index batch_size = 32;
  OptimizerOptions optimizer{};
  Schedule schedule;  // in steps
  std::uint64_t seed = 0;
  std::string input_fingerprint;  // copied into checkpoints
};

/// Trains a graph with inputs (top view, angles) and one score by mean squared error. The processes of a communicator
/// all do the same steps, each with all parameters, and share the products of dense layers: every sum over a batch is
/// made in the order of its examples, so the bits do not depend on how many they are.
class Trainer {
 public:
  /// `validation` may be empty (nullptr). Keeps references.
  Trainer(const Graph& graph, const TrainingSet& training, const TrainingSet* validation, const TrainerOptions& options,
          Communicator& communicator = SingleProcess::shared());

  /// What a training starts from.
  Checkpoint beginning(Parameters parameters) const;

  /// Goes on from a checkpoint with the same bits as if it had never stopped, changing its parameters in place. After
  /// each epoch calls `after_epoch` with the state and whether the epoch is the best so far: by validation loss where
  /// there is a validation set, else by training loss. Throws Error where the loss or a gradient is not finite, or
  /// where the processes of the communicator do not compute the same.
  void train(Checkpoint state, const std::function<void(const Checkpoint&, bool best)>& after_epoch,
             const Messages& messages);

  /// For reading a checkpoint: the shapes of the optimizer's state.
  std::vector<Shape> optimizer_shapes() const;

  Index steps_per_epoch() const;

 private:
  double step(std::span<const std::int32_t> examples, Parameters& parameters, Optimizer& optimizer) const;
  double mean_loss(const TrainingSet& set, const Parameters& parameters) const;
  std::unique_ptr<Optimizer> new_optimizer(const Parameters& parameters) const;

  const Graph& graph_;
  const TrainingSet& training_;
  const TrainingSet* validation_;
  TrainerOptions options_;
  Communicator& communicator_;
};

}  // namespace svnet
