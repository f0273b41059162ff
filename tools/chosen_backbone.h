#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/keras/keras_graph.h"
#include "train/feature_extraction.h"

namespace svnet {

/// The backbone of the options --backbone, --layer and --weights: with the weights of a file, or built in if `weights`
/// is empty. Throws Error for an unknown name, for a file that does not fit, and if no weights are built in.
train::BackboneWithOrigin chosen_backbone(const std::string& backbone, const std::string& layer,
                                          const std::filesystem::path& weights, io::KerasLoadReport& report,
                                          const InferenceOptions& options);

/// The names that --backbone takes.
std::vector<std::string> backbone_names();

}  // namespace svnet
