#pragma once
#include <string>
#include <vector>

#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"
#include "nn/kernels/convolution_choice.h"
#include "nn/kernels/precision.h"
#include "nn/runtime/step.h"

namespace svnet::runtime {

/// Position of a value in Program::sizes.
using ValueId = int;

struct ProgramStep {
  std::string layer;  // the last layer that the step stands for
  StepPointer step;
  std::vector<ValueId> inputs;
  ValueId output;
};

/// A graph as a list of steps over values. The first values are the graph's inputs, in order.
struct Program {
  std::vector<Shape> inputs;  // shapes without the batch
  Shape output_shape;
  std::vector<ProgramStep> steps;
  std::vector<Index> sizes;  // numbers of each value for one sample
  ValueId output;            // written by exactly one step
};

using kernels::Convolution;
using kernels::Precision;

/// Compiles what `output` needs: batch norms folded, and padding, activations, additions, pooling, and the pointwise
/// half of separable convolutions fused into the convolution beside them wherever nobody else reads what lies between.
/// Parameters must be f32, and the machine must have products of the precision (Error otherwise).
Program compile(const Graph& graph, const Parameters& parameters, NodeId output, Convolution convolution,
                Precision precision = Precision::f32);

}  // namespace svnet::runtime
