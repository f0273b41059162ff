#pragma once
#include "models/preprocessing.h"
#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

namespace svnet::models {

/// A graph with its parameters.
struct GraphWithParameters {
  Graph graph;
  Parameters parameters;
};

/// The graph with a first layer `preprocessing`, so that it takes RGB values 0 to 255: a 1 x 1 convolution that does
/// what preprocess() does, up to rounding. Requires that the graph has one input, an image.
GraphWithParameters with_preprocessing(PixelMode mode, const Graph& graph, const Parameters& parameters);

/// `backbone`, its output as a row, and `head`, whose first input it becomes. The other inputs of the head keep their
/// names. Throws Error if a layer of one has the name of a layer of the other, or if shapes do not fit.
Graph joined_graph(const Graph& backbone, const Graph& head);

}  // namespace svnet::models
