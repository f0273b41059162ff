#pragma once
#include "models/pose_head.h"
#include "nn/graph/parameters.h"
#include "train/ridge.h"

namespace svnet::train {

struct NetworkFitOptions {
  models::PoseNetworkOptions network{};
  Index epochs = 12;
  Index poses_per_batch = 16;
  double learning_rate = 2e-3, weight_decay = 1e-2;
  double input_noise = 0.5;  ///< standard deviation, in those of the inputs
  std::uint64_t seed = 0;
};

/// The parameters of models::pose_network, fitted to differences within poses: the loss is the mean square of
/// prediction minus y after the weighted mean of its pose was subtracted from both, with the examples' weights. Inputs
/// are standardised while training, and the first layer then takes them as they are. The mean prediction of the
/// examples is 0. Throws Error as training_step does. Has the same bits for any number of threads.
Parameters fit_network(const PoseExamples& examples, const NetworkFitOptions& options);

/// The outputs of a network with these parameters, one per example. Only x and inputs of the examples count.
std::vector<double> network_predictions(const Parameters& parameters, const PoseExamples& examples,
                                        const models::PoseNetworkOptions& options);

}  // namespace svnet::train
