#pragma once
#include <string>
#include <vector>

#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"
#include "nn/runtime/inference_options.h"
#include "nn/runtime/step.h"

namespace svnet::runtime {

/// Position of a value in Program::sizes.
using ValueId = int;

struct ProgramStep {
  std::string layer;  // the last layer that the step computes
  StepPointer step;
  std::vector<ValueId> inputs;
  ValueId output;
};

/// A graph as a list of steps over values. The first values are the graph's inputs, in order.
struct Program {
  std::vector<Shape> inputs;  // shapes without the batch
  Shape output_shape;
  std::vector<ProgramStep> steps;
  std::vector<Index> sizes;  // elements of each value, for one sample
  ValueId output;            // written by exactly one step
};

using kernels::Convolution;
using kernels::Precision;

/// Compiles the layers that `output` depends on. Batch norms are folded. Padding, activations, additions, pooling and
/// the pointwise half of separable convolutions are fused into the convolution beside them, unless another layer reads
/// the value between them. Throws Error if parameters are not f32 or the machine lacks the precision.
Program compile(const Graph& graph, const Parameters& parameters, NodeId output, const InferenceOptions& options);

}  // namespace svnet::runtime
