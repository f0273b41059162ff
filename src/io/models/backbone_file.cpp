#include "io/models/backbone_file.h"

#include <nlohmann/json.hpp>

#include "base/sha256.h"
#include "io/models/built_in_weights.h"
#include "io/tensors/tensor_file.h"

namespace svnet::io {
using models::Backbone;
using models::BackboneKind;

namespace {

constexpr const char* kKind = "weights";

Backbone backbone_of(const TensorFile& file, const std::string& name, const std::string& layer, KerasLoadReport* report,
                     const InferenceOptions& options) {
  const BackboneKind& kind = models::backbone_kind(name);
  const auto written_for = file.get<std::string>("backbone");
  check(written_for == name, file.path(), ": holds weights of ", written_for, ", expected weights of ", name);
  const Graph graph = kind.graph(kind.preprocessing.height, false);
  const NodeId output = output_layer(kind, graph, layer);
  const Parameters parameters = file.parameters("", graph);
  file.check_holds_only(parameters);
  if (report != nullptr) {
    *report = {};
    const std::vector<bool> needed = graph.ancestors({output});
    for (std::size_t id = 0; id < needed.size(); ++id)
      if (const GraphNode& node = graph.nodes()[id]; !node.parameters.empty())
        (needed[id] ? report->loaded : report->unused).push_back(node.name);
  }
  return {kind, graph, parameters, layer, options};
}

}  // namespace

void write_backbone(const std::filesystem::path& path, const Backbone& backbone, const std::string& origin) {
  TensorFile file;
  file.description() = {{"kind", kKind}, {"backbone", backbone.kind().name}, {"origin", origin}};
  file.add("", backbone.parameters());
  file.write(path);
}

Backbone read_backbone(const std::string& name, const std::filesystem::path& weights, const std::string& layer,
                       KerasLoadReport* report, const InferenceOptions& options) {
  if (weights.extension() == ".safetensors")
    return backbone_of(TensorFile::read(weights, kKind), name, layer, report, options);
  return read_keras_backbone(name, weights, layer, report, options);
}

bool has_built_in_weights(const BackboneKind& kind) { return !built_in_weights(kind.name).empty(); }

std::optional<BuiltInBackbone> built_in_backbone(const std::string& name, const std::string& layer,
                                                 const InferenceOptions& options) {
  if (!has_built_in_weights(models::backbone_kind(name))) return {};
  const auto contents = built_in_weights(name);
  Sha256 hash;
  hash.update(contents.data(), contents.size());
  return BuiltInBackbone{
      backbone_of(TensorFile::parse("built-in weights of " + name, contents, kKind), name, layer, nullptr, options),
      hash.hex()};
}

std::optional<std::filesystem::path> find_weights(const BackboneKind& kind, const std::filesystem::path& folder) {
  if (auto path = folder / (kind.name + ".safetensors"); std::filesystem::exists(path)) return path;
  for (const auto& name : kind.weight_files)
    if (auto path = folder / name; std::filesystem::exists(path)) return path;
  return {};
}

}  // namespace svnet::io
