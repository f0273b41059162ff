#pragma once
#include <string>
#include <vector>

#include "io/keras/keras_weights.h"
#include "nn/graph/graph.h"

namespace svnet::io {

/// The layers of one model in a weights file beside those of a graph.
struct KerasMatch {
  std::string model;               // KerasLayer::model
  std::vector<KerasLayer> layers;  // the i-th belongs to the i-th of the graph's if i < fitting
  std::size_t fitting = 0;
  std::string problem;  // why layer `fitting` of the graph has no weights, or those of another layer; else empty
};

/// Compares each model in the file, the file's own and those nested in it, with `order`: layers with weights of the
/// graph, in Keras' order. The i-th layer of a legacy model belongs to the i-th of `order`, that of a nested legacy
/// model to the one of its name if all of the first `named` have one. The k-th layer of a class of a Keras 3 model
/// belongs to the k-th of that class. Layers of the file without weights are left out.
std::vector<KerasMatch> keras_matches(const KerasWeightsFile& file, const Graph& graph,
                                      const std::vector<NodeId>& order, std::size_t named);

}  // namespace svnet::io
