#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "models/backbone.h"

namespace svnet {

/// What became of every layer with weights, in a weights file and in the graph.
struct KerasLoadReport {
  std::vector<std::string> loaded;  // graph layers that were filled, "block_1_expand"
  std::vector<std::string> unused;  // layers of the file that the output does not need: a top that was not asked for
};

/// The backbone with the weights of a Keras file, legacy layout or Keras 3. Layers are matched by position among those
/// with weights, in the order of Keras' model.layers (keras_order); Keras 3 files by class and counter in the same
/// order. All layers are checked, also those of the top where the file has one; only the numbers that the output needs
/// are read. Throws Error that names file and layers for anything missing, unexpected or of another shape; a name in
/// the file that belongs to another layer means that the order is wrong.
Backbone read_keras_backbone(const std::string& name, const std::filesystem::path& weights, const std::string& layer,
                             KerasLoadReport* report = nullptr);

}  // namespace svnet
