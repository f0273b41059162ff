#pragma once
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet {

/// A graph and its parameters, for inference.
struct FoldedGraph {
  Graph graph;
  Parameters parameters;
};

/// The layers that `output` needs; `output` becomes the last node. Each batch norm is folded into the convolution or
/// dense layer before it, and each ReLU or ReLU6 into the layer before it, unless another layer reads the value between
/// them. A node has the name of the last layer that it stands for. Values agree with the original up to rounding.
FoldedGraph folded(const Graph& graph, const Parameters& parameters, NodeId output);

}  // namespace svnet
