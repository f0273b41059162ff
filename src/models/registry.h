#pragma once
#include <string>
#include <vector>

#include "models/backbone_kind.h"

namespace svnet::models {

/// Every backbone that is known by name.
const std::vector<BackboneKind>& backbone_kinds();

/// Throws Error with the nearest name if there is none of that name.
const BackboneKind& backbone_kind(const std::string& name);

/// The node of `graph` that `layer` names. "" and Keras' names for the pooled output (avg_pool,
/// global_average_pooling2d) mean `kind.pooled`. Throws Error if the graph has no such layer.
NodeId output_layer(const BackboneKind& kind, const Graph& graph, const std::string& layer);

}  // namespace svnet::models
