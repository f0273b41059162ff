#include "models/registry.h"

#include "base/text.h"
#include "models/backbones.h"

namespace svnet::models {

const std::vector<BackboneKind>& backbone_kinds() {
  static const std::vector<BackboneKind> kinds = [] {
    std::vector<BackboneKind> all;
    for (const auto backbone : models::kBackbones) all.push_back(backbone());
    return all;
  }();
  return kinds;
}

const BackboneKind& backbone_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& kind : backbone_kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  fail("[backbone] there is no backbone '", name, "'", suggestion(name, names));
}

NodeId output_layer(const BackboneKind& kind, const Graph& graph, const std::string& layer) {
  const bool pooled = layer.empty() || layer == "avg_pool" || layer == "global_average_pooling2d";
  return graph.find(pooled ? kind.pooled : layer);
}

}  // namespace svnet::models
