#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "nn/graph/graph.h"

namespace svnet::io {

/// A graph as the configuration of a Keras 3 model, the contents of config.json in a .keras file: a functional model
/// whose last layer is its output. Throws Error that names the layer for what Keras has no attribute for: explicit
/// padding of a convolution or pool.
nlohmann::json keras_config(const Graph& graph);

/// The graph of a configuration that keras_config made. Throws Error, which begins with `where`, for others.
Graph graph_of_keras_config(const nlohmann::json& config, const std::string& where);

}  // namespace svnet::io
