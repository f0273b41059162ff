#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "io/keras/keras_graph.h"

// The weights of backbones: files that Keras publishes (io/keras_graph.h), files of svnet's own, whose names end in
// .safetensors, and those that are built in (data/).
namespace svnet {

/// Writes a TensorFile of kind "weights": tensors "<layer>/<parameter>"; description {"backbone", "origin"}, `origin`
/// being a line on how they were made. Replaces the file as a whole.
void write_backbone(const std::filesystem::path& path, const Backbone& backbone, const std::string& origin);

/// The backbone with the weights of the file, of either kind. Throws Error that names the file and the layer or tensor
/// for anything missing, unexpected or of another shape.
Backbone read_backbone(const std::string& name, const std::filesystem::path& weights, const std::string& layer = "",
                       KerasLoadReport* report = nullptr);

/// Whether weights of the backbone are part of the program: tiny_xception alone has some.
bool has_built_in_weights(const BackboneKind& kind);

/// A backbone with the weights that are part of the program, and the SHA-256 of the file that they were.
struct BuiltInBackbone {
  Backbone backbone;
  std::string sha256;
};
/// Empty where the backbone has none. Throws Error where there is no such backbone or layer.
std::optional<BuiltInBackbone> built_in_backbone(const std::string& name, const std::string& layer = "");

/// The file of the backbone's weights in a folder: <name>.safetensors, or one of the names under which Keras publishes
/// them; empty where there is none.
std::optional<std::filesystem::path> find_weights(const BackboneKind& kind, const std::filesystem::path& folder);

}  // namespace svnet
