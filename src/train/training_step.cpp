#include "train/training_step.h"

#include <cmath>

#include "base/error.h"
#include "nn/graph/run.h"
#include "train/finite.h"

namespace svnet::train {

StepResult training_step(const Graph& graph, Parameters& parameters, Optimizer& optimizer,
                         const std::vector<Tensor>& inputs, const std::function<Tensor(const Tensor& output)>& loss,
                         const StepOptions& options) {
  const TrainingContext context{.seed = options.seed,
                                .step = static_cast<std::uint64_t>(optimizer.steps),
                                .communicator = options.communicator,
                                .convolution = options.convolution};
  const Tensor output = run_training(graph, parameters, inputs, {graph.output()}, context)[0];
  const Tensor loss_value = loss(output);
  const auto check_step = [&](bool finite, const char* what) {
    check(finite, "[", options.task, "] ", what, " is not finite at step ", optimizer.steps,
          "; a smaller learning rate may help");
  };
  check_step(std::isfinite(loss_value.item()), "the loss");
  autograd::GradientMap gradients(options.products);
  autograd::backward(loss_value, gradients);
  for (const Tensor& parameter : trainable(graph, parameters))
    check_step(has_finite_gradient(gradients, parameter), "a gradient");
  optimizer.step(gradients, options.learning_rate);
  return {output, loss_value.item()};
}

}  // namespace svnet::train
