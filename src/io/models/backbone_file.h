#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "io/keras/keras_graph.h"

// The weights of backbones: files of Keras (io/keras/keras_graph.h), files of svnet's own, whose names end in
// .safetensors, and weights that are part of the program (data/tiny_xception.safetensors).
namespace svnet::io {

/// Writes a TensorFile of kind "weights" with the tensors "<layer>/<parameter>" and the description {"backbone",
/// "origin"}. `origin` is one line that says how the weights were made. Replaces the file as a whole.
void write_backbone(const std::filesystem::path& path, const models::Backbone& backbone, const std::string& origin);

/// The backbone with the weights of a Keras or safetensors file. Throws Error that names the file and the layer or
/// tensor if one is missing, unexpected or of another shape.
models::Backbone read_backbone(const std::string& name, const std::filesystem::path& weights,
                               const std::string& layer = "", KerasLoadReport* report = nullptr,
                               const InferenceOptions& options = {});

/// Whether weights of the backbone are part of the program. Only tiny_xception has some.
bool has_built_in_weights(const models::BackboneKind& kind);

/// A backbone with the weights that are part of the program, and the SHA-256 of their file.
struct BuiltInBackbone {
  models::Backbone backbone;
  std::string sha256;
};
/// Empty if the backbone has no built-in weights. Throws Error for an unknown backbone or layer.
std::optional<BuiltInBackbone> built_in_backbone(const std::string& name, const std::string& layer = "",
                                                 const InferenceOptions& options = {});

/// The file of the backbone's weights in a folder: <name>.safetensors, or a name under which Keras publishes them.
/// Empty if there is none.
std::optional<std::filesystem::path> find_weights(const models::BackboneKind& kind,
                                                  const std::filesystem::path& folder);

}  // namespace svnet::io
