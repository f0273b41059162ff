#pragma once
#include <string>
#include <vector>

#include "models/preprocessing.h"
#include "nn/graph/graph.h"

namespace svnet {

/// A backbone network that is known by name.
struct BackboneKind {
  std::string name;              // "mobilenet_v2"
  std::string pooled;            // the layer that gives the features where none is asked for
  std::string last_block_input;  // the layer whose output is all that the last block, and what follows it, takes
  Preprocessing preprocessing;
  Graph (*graph)(Index size, bool top);
  std::vector<std::string> weight_files;  // the names under which Keras publishes its weights, best first
};

const std::vector<BackboneKind>& backbone_kinds();

/// Throws Error with the nearest name where there is none of that name.
const BackboneKind& backbone_kind(const std::string& name);

/// The layer that `layer` means in `graph`: "" and Keras' names for the pooled output (avg_pool,
/// global_average_pooling2d) stand for `kind.pooled`. Throws Error where the graph has no such layer.
NodeId output_layer(const BackboneKind& kind, const Graph& graph, const std::string& layer);

}  // namespace svnet
