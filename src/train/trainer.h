#pragma once
#include <functional>
#include <string>

#include "base/communicator.h"
#include "base/progress.h"
#include "io/models/checkpoint.h"
#include "nn/kernels/convolution_choice.h"
#include "nn/optim/optimizer.h"
#include "nn/optim/schedule.h"
#include "train/training_set.h"

namespace svnet::train {

struct TrainerOptions {
  Index epochs = 10;
  Index patience = 0;  ///< stop after this many epochs without a better one; 0: never
  Index batch_size = 32;
  OptimizerOptions optimizer{};
  Schedule schedule;  // in steps
  std::uint64_t seed = 0;
  kernels::Convolution convolution = kernels::Convolution::automatic;
  std::string input_fingerprint;  // copied into checkpoints
};

/// Trains a graph with the inputs (top view, angles) and one score as output, by mean squared error with the weights of
/// the targets. All processes of a communicator do the same steps with all parameters, and share the products of dense
/// layers. Sums over a batch are taken in the order of its examples, so the bits do not depend on the number of
/// processes.
class Trainer {
 public:
  /// On the validation set.
  struct Validation {
    Index examples = 0;  ///< 0: there is no validation set
    double loss = 0;
    WithinPose within_pose;
  };

  /// `validation` may be nullptr. Keeps references.
  Trainer(const Graph& graph, const TrainingSet& training, const TrainingSet* validation, const TrainerOptions& options,
          Communicator& communicator = SingleProcess::shared());

  /// The state before the first step.
  io::Checkpoint initial_state(Parameters parameters) const;

  struct Callbacks {
    /// After each epoch, with the state, and with whether the epoch is the best so far: by Spearman's rank correlation
    /// within the poses of the validation set if there is one, otherwise by training loss.
    std::function<void(const io::Checkpoint&, bool best)> after_epoch;
    /// If messages.progress throws within an epoch because the program is to end: with the state after the last step.
    std::function<void(const io::Checkpoint&)> interrupted{};
  };

  /// Continues from a checkpoint, with the bits of a training that was not interrupted; changes its parameters in
  /// place. Throws Error if the loss or a gradient is not finite, if the checkpoint has more steps of an epoch than
  /// there are, or if the processes of the communicator have different parameters.
  void train(io::Checkpoint state, const Callbacks& callbacks, const Messages& messages);

  /// The shapes of the optimizer's state, which read_checkpoint needs.
  std::vector<Shape> optimizer_shapes() const;

  Index steps_per_epoch() const;

 private:
  /// The rest of an epoch. Returns the sum of the losses of the whole epoch.
  double finish_epoch(io::Checkpoint& state, Optimizer& optimizer, const Callbacks& callbacks, Progress& progress,
                      Index& done) const;
  double step(std::span<const std::int32_t> examples, Parameters& parameters, Optimizer& optimizer) const;
  Validation validate(const Parameters& parameters) const;
  std::unique_ptr<Optimizer> new_optimizer(const Parameters& parameters) const;

  const Graph& graph_;
  const TrainingSet& training_;
  const TrainingSet* validation_;
  TrainerOptions options_;
  Communicator& communicator_;
};

}  // namespace svnet::train
