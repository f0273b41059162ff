#pragma once
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet {

/// A graph with its numbers, for inference.
struct FoldedGraph {
  Graph graph;
  Parameters parameters;
};

/// The layers that `output` (the last node of the result) needs, with each batch norm folded into the convolution or
/// dense layer before it, and each ReLU or ReLU6 into its producer, wherever nobody else reads what lies between. The
/// nodes keep the name of the last layer that they stand for. Values agree with the original up to rounding.
FoldedGraph folded(const Graph& graph, const Parameters& parameters, NodeId output);

}  // namespace svnet
