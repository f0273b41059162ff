#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "nn/graph/graph.h"

namespace svnet {

// A graph as JSON: a list of nodes {"name", "kind", "inputs": [names], attributes…}; the kinds are Keras' class names,
// the attributes those that the layers visit (nn/layers).

nlohmann::json graph_to_json(const Graph& graph);

/// `where` begins every error message ("model.safetensors: backbone"). Throws Error that names the node and the
/// attribute for anything that is missing, of the wrong type or does not make a graph.
Graph graph_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace svnet
