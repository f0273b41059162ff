#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "models/backbone.h"

namespace svnet::io {

/// Which layers with weights were loaded from a weights file.
struct KerasLoadReport {
  std::vector<std::string> loaded;  // layers of the graph, such as "block_1_expand"
  std::vector<std::string> unused;  // layers of the file that the output does not need, such as those of the top
};

/// The backbone with the weights of a Keras file, legacy layout or Keras 3. The i-th layer with weights in the file
/// belongs to the i-th one of the graph in the order of Keras' model.layers (keras_order). In Keras 3 files the layers
/// are first put into that order by class and counter. All layers are checked, those of the top too if the file has it;
/// only the weights that the output needs are read.
///
/// Throws Error that names the file and the layer if one is missing, unexpected or of another shape, or has the name of
/// another layer of the graph.
models::Backbone read_keras_backbone(const std::string& name, const std::filesystem::path& weights,
                                     const std::string& layer, KerasLoadReport* report = nullptr,
                                     const InferenceOptions& options = {});

}  // namespace svnet::io
