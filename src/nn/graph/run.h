#pragma once
#include <vector>

#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"
#include "nn/kernels/convolution_choice.h"

namespace svnet {

class Communicator;

/// The context of a training step. Dropout masks depend on the seed, the step and the layer only.
struct TrainingContext {
  std::uint64_t seed = 0;
  std::uint64_t step = 0;
  /// If set: all its processes run the same step, and each computes a share of the products of dense layers, forward
  /// and backward.
  Communicator* communicator = nullptr;
  kernels::Convolution convolution = kernels::Convolution::automatic;
};

/// Runs the layers that `outputs` depend on and returns the values of `outputs`, in their order. `inputs` are batches
/// for graph.inputs(), in order, of the parameters' element type. A value is released as soon as its last reader has
/// run. Inference: batch norm uses the moving statistics, dropout does nothing, nothing is recorded.
std::vector<Tensor> run_inference(const Graph& graph, const Parameters& parameters, const std::vector<Tensor>& inputs,
                                  const std::vector<NodeId>& outputs);

/// Training: batch norm uses the batch and updates the moving statistics, dropout is applied, the tape is recorded.
std::vector<Tensor> run_training(const Graph& graph, Parameters& parameters, const std::vector<Tensor>& inputs,
                                 const std::vector<NodeId>& outputs, const TrainingContext& context);

}  // namespace svnet
