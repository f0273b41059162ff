#pragma once
#include <vector>

#include "nn/graph/graph.h"

namespace svnet {

/// The layers that `output` depends on, in the order of `model.layers` of a Keras model with that output; weight files
/// list layers in this order. Layers are sorted by decreasing depth (the longest path to the output). Layers of equal
/// depth stand in the order in which a depth-first walk from the output, inputs first to last, meets them first
/// (keras.src.ops.function.map_graph).
std::vector<NodeId> keras_order(const Graph& graph, NodeId output);

}  // namespace svnet
