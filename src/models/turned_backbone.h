#pragma once
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

// The end of a backbone whose image is turned to the camera: it keeps roughly where things are, and little else.
namespace svnet::models {

/// `backbone` with its output as a row of values. An output (H, W, C) with H and W of at least 3 is averaged over 3 x 3
/// windows that cover all of it and overlap by as little as they can: their sides are H - 2 ⌊H / 3⌋ and
/// W - 2 ⌊W / 3⌋, their strides ⌊H / 3⌋ and ⌊W / 3⌋. So 7 x 7 gives rows and columns 0-2, 2-4 and 4-6. Smaller and
/// pooled outputs are taken as they are.
Graph pooled_graph(const Graph& backbone);

/// `pooled` and a dense layer `projection` of `components` units.
Graph projected_graph(const Graph& pooled, Index components);

/// The dense layer alone: input `pooled` (inputs), output `projection` (components). Its parameters have the same
/// names.
Graph projection_graph(Index inputs, Index components);

}  // namespace svnet::models
