#pragma once
#include <functional>
#include <vector>

#include "base/communicator.h"
#include "nn/autograd.h"
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"
#include "nn/kernels/convolution_choice.h"
#include "nn/optim/optimizer.h"

namespace svnet::train {

struct StepOptions {
  const char* task = "training";  ///< begins error messages
  double learning_rate = 0;
  std::uint64_t seed = 0;  ///< of dropout
  /// Whether gradients of dense layers are computed, or kept as two factors for the optimizer.
  autograd::GradientMap::Products products = autograd::GradientMap::Products::compute;
  kernels::Convolution convolution = kernels::Convolution::automatic;
  Communicator* communicator = nullptr;  ///< whose processes share the products of dense layers
};

struct StepResult {
  Tensor output;  ///< of the graph, before the step
  double loss = 0;
};

/// One training step: runs the graph on a batch, computes the scalar `loss(output)` and the gradients, and lets the
/// optimizer change the trainable parameters. The step's number is the optimizer's count of steps. Throws Error if the
/// loss or a gradient is not finite; then only moving statistics have changed.
StepResult training_step(const Graph& graph, Parameters& parameters, Optimizer& optimizer,
                         const std::vector<Tensor>& inputs, const std::function<Tensor(const Tensor& output)>& loss,
                         const StepOptions& options);

}  // namespace svnet::train
