#include "chosen_backbone.h"

#include "io/files/file_hash.h"
#include "io/models/backbone_file.h"

namespace svnet {

train::BackboneWithOrigin chosen_backbone(const std::string& backbone, const std::string& layer,
                                          const std::filesystem::path& weights, io::KerasLoadReport& report,
                                          const InferenceOptions& options) {
  if (!weights.empty())
    return {io::read_backbone(backbone, weights, layer, &report, options), io::file_sha256(weights)};
  auto built_in = io::built_in_backbone(backbone, layer, options);
  check(built_in.has_value(), "no weights of ", backbone, " are built in; give a file by --weights");
  return {std::move(built_in->backbone), built_in->sha256};
}

command::Argument add_backbone_options(command::Command& command, std::string& backbone, std::filesystem::path& weights,
                                       const std::string& network, const std::string& hint) {
  std::vector<std::string> names;
  for (const models::BackboneKind& kind : models::backbone_kinds()) names.push_back(kind.name);
  const auto option = command.add("--backbone", backbone, network + ": " + joined_with(", ", names)).value_name("NAME");
  command
      .add("--weights", weights,
           "Its weights: Keras HDF5, or .safetensors of svnet-pretrain (default: built in, for tiny_xception alone)" +
               hint)
      .value_name("FILE");
  return option;
}

}  // namespace svnet
