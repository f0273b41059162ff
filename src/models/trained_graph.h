#pragma once
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet {

/// What is trained, as one graph: the layers of `backbone` between `from` and `output`, called "backbone/<layer>", and
/// `head`, called "head/<layer>", whose first input takes the numbers of `output`. Its inputs are the output of `from`
/// and the other inputs of the head. Where `from` is `output`, the backbone has no part in it and the first input is
/// the head's own. Throws Error where a layer that `output` needs has a way to the backbone's input past `from`.
Graph trained_graph(const Graph& backbone, NodeId from, NodeId output, const Graph& head);

/// Parameters of a trained graph to begin with: the backbone's numbers, copied, and the head's from their initialisers.
Parameters trained_parameters(const Graph& trained, const Parameters& backbone, const Graph& head, std::uint64_t seed);

/// Replaces in `backbone` and `head` what a trained graph has parameters for.
void take_trained(const Parameters& trained, Parameters& backbone, Parameters& head);

}  // namespace svnet
