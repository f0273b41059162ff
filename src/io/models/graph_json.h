#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "nn/graph/graph.h"

namespace svnet::io {

// A graph as JSON: a list of nodes {"name", "kind", "inputs": [names], attributes…}. The kinds are Keras' class names;
// the attributes are those that the layers visit (nn/layers).

nlohmann::json graph_to_json(const Graph& graph);

/// Throws Error that names the node and the attribute if something is missing, of the wrong type, or the nodes do not
/// make a graph. `where` begins the message ("model.safetensors: backbone").
Graph graph_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace svnet::io
