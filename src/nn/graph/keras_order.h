#pragma once
#include <vector>

#include "nn/graph/graph.h"

namespace svnet {

/// The ancestors of `output` in the order of Keras' `model.layers` for a functional model with that output: by
/// decreasing depth (the longest way to the output), and within a depth in the order in which a depth-first walk from
/// the output, inputs first to last, first meets them (keras.src.ops.function.map_graph). Weight files list layers so.
std::vector<NodeId> keras_order(const Graph& graph, NodeId output);

}  // namespace svnet
