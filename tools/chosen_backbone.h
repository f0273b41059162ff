#pragma once
#include <filesystem>
#include <string>

#include "command/command.h"
#include "io/keras/keras_graph.h"
#include "train/feature_extraction.h"

namespace svnet {

/// The backbone of the options --backbone, --layer and --weights: with the weights of a file, or built in if `weights`
/// is empty. Throws Error for an unknown name, for a file that does not fit, and if no weights are built in.
train::BackboneWithOrigin chosen_backbone(const std::string& backbone, const std::string& layer,
                                          const std::filesystem::path& weights, io::KerasLoadReport& report,
                                          const InferenceOptions& options);

/// Adds --backbone NAME and --weights FILE. `network`: how the help begins to say what the network does. `hint`: what
/// the help says after the kinds of weights. Returns the former, which may be required or show its default.
command::Argument add_backbone_options(command::Command& command, std::string& backbone, std::filesystem::path& weights,
                                       const std::string& network, const std::string& hint = "");

}  // namespace svnet
