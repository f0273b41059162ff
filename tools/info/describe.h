#pragma once
#include <filesystem>
#include <string>

namespace svnet {

/// A few lines that say what a file of svnet's or of Keras' contains: features, scores, weights, checkpoint, model.
/// `with_tensors`: also the tensors of a model. Throws Error that names any other file.
std::string description_of(const std::filesystem::path& file, bool with_tensors = false);

}  // namespace svnet
