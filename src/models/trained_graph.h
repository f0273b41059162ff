#pragma once
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet::models {

/// The part of a model that is trained, as one graph: the layers of `backbone` after `from` up to `output`, named
/// "backbone/<layer>", and `head`, named "head/<layer>", whose first input reads `output` (flattened). The inputs of
/// the graph are the output of `from` and the head's other inputs. If `from` is `output`, no layer of the backbone is
/// trained and the inputs are the head's own.
/// Throws Error if `output` depends on the backbone's input by a way that does not lead through `from`.
Graph trained_graph(const Graph& backbone, NodeId from, NodeId output, const Graph& head);

/// Parameters to start training from: copies of the backbone's, and the head's from their initialisers.
Parameters trained_parameters(const Graph& trained, const Parameters& backbone, const Graph& head, std::uint64_t seed);

/// Copies the trained parameters back into those of `backbone` and `head`.
void take_trained(const Parameters& trained, Parameters& backbone, Parameters& head);

}  // namespace svnet::models
