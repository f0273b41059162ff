#pragma once
#include <filesystem>

#include "nn/graph/graph.h"
#include "nn/graph/parameters.h"

// A Keras 3 model as a folder: config.json (keras_config.h), metadata.json and model.weights.h5, the contents of a
// .keras file. keras.saving.load_model(FOLDER) reads it.
namespace svnet::io {

/// Fills an existing folder. Throws Error that names the file, and for layers as keras_config does.
void write_keras_model(const std::filesystem::path& folder, const Graph& graph, const Parameters& parameters);

/// A model that write_keras_model wrote.
struct KerasModel {
  Graph graph;
  Parameters parameters;
};
/// Throws Error that names the file.
KerasModel read_keras_model(const std::filesystem::path& folder);

}  // namespace svnet::io
