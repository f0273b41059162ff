#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "data/model.h"

namespace svnet::io {

// The file is a TensorFile of kind "model" with the tensors "backbone/<layer>/<parameter>" and
// "head/<layer>/<parameter>". Its description is {"backbone": {"name", "output", "graph"}, "preprocessing": {"pixels",
// "height", "width", "interpolation", "channels"}, "head": {"graph", "orientations"}, "angles": {"encoding", "unit",
// "order"}, "input_fingerprint"}. "orientations" is the number of symmetries and is left out if it is 1.
// "precision" is left out if it is f32. What the model was trained on and what it reached: model_origin.h.
// A model in another frame than `camera` has "frame": {"kind", "depth"} instead of "angles". In the frame `axis` it has
// no tensors of a backbone, and neither "backbone" nor "preprocessing".

/// Replaces the file as a whole. Layers of the backbone that its output does not need are left out.
void write_model(const std::filesystem::path& path, const Model& model);

/// Throws Error that names the file and says what is wrong.
Model read_model(const std::filesystem::path& path);

/// The same for the contents of a file in memory. Errors call it `name`.
Model parse_model(const std::string& name, std::span<const std::byte> contents);

/// Reads only the fingerprint, and no tensor: they may be hundreds of megabytes. Throws Error unless the file is a
/// model of this version.
std::string read_model_fingerprint(const std::filesystem::path& path);

}  // namespace svnet::io
