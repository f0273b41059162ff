#pragma once
#include <optional>

#include "nn/runtime/folding.h"

namespace svnet::predict {

/// A graph that is cut where its first input meets the others, so that one value of the first input can be combined
/// with many values of the others at little cost.
struct SplitGraph {
  FoldedGraph once;  ///< reads the first input; output (units)
  FoldedGraph each;  ///< reads the output of `once`, then the other inputs in their order; the output of the whole
};

/// Cuts a graph in which everything that depends on the first input alone leads into one concatenation, and that into
/// one dense layer. Its kernel is cut by rows: `once` ends in W_first x + bias, and `each` begins with adding
/// W_others a to it, before the activation. Batch norms are folded first (runtime/folding.h); dropout between the two
/// layers is left out. Values agree with those of the whole graph up to rounding.
/// Returns nothing if the graph has another form.
std::optional<SplitGraph> split_graph(const Graph& graph, const Parameters& parameters, NodeId output);

}  // namespace svnet::predict
