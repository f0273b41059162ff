#pragma once
#include <filesystem>

#include "data/model.h"

namespace svnet {

// A TensorFile of kind "model": tensors "backbone/<layer>/<parameter>" and "head/<layer>/<parameter>"; description
// {"backbone": {"name", "output", "graph"}, "preprocessing": {"pixels", "height", "width", "interpolation",
// "channels"}, "head": {"graph", "orientations": only where not 1}, "angles": {"encoding", "unit", "order"},
// "input_fingerprint"}.

/// Replaces the file as a whole. Layers of the backbone above its output are left out.
void write_model(const std::filesystem::path& path, const Model& model);

/// Throws Error that names the file and what is wrong with it.
Model read_model(const std::filesystem::path& path);

}  // namespace svnet
