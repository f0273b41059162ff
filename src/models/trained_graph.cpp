#include "models/trained_graph.h"

#include <map>
#include <string_view>

namespace svnet::models {
namespace {

constexpr std::string_view kBackbone = "backbone/", kHead = "head/";

std::string prefixed(std::string_view prefix, const std::string& name) { return std::string(prefix) + name; }

}  // namespace

Graph trained_graph(const Graph& backbone, NodeId from, NodeId output, const Graph& head) {
  Graph trained;
  NodeId features = -1;
  if (from != output) {
    const auto needed = backbone.ancestors({output}), below = backbone.ancestors({from});
    std::map<NodeId, NodeId> place{
        {from, trained.input(prefixed(kBackbone, backbone.node(from).name), backbone.node(from).shape)}};
    for (NodeId id = 0; id <= output; ++id) {
      if (!needed[static_cast<std::size_t>(id)] || below[static_cast<std::size_t>(id)]) continue;
      const GraphNode& node = backbone.node(id);
      std::vector<NodeId> inputs;
      for (const NodeId input : node.inputs) {
        check(place.count(input) != 0, "[trained_graph] layer '", node.name, "' takes '", backbone.node(input).name,
              "', which lies below '", backbone.node(from).name, "'");
        inputs.push_back(place.at(input));
      }
      place[id] = trained.add(prefixed(kBackbone, node.name), node.layer, inputs);
    }
    check(place.count(output) != 0, "[trained_graph] layer '", backbone.node(output).name, "' lies below '",
          backbone.node(from).name, "'");
    features = place.at(output);
    if (trained.node(features).shape.size() != 1) features = trained.add("features", FlattenLayer{}, {features});
  }
  const NodeId first_input = head.inputs().at(0);
  std::map<NodeId, NodeId> place;
  for (NodeId id = 0; id <= head.output(); ++id) {
    const GraphNode& node = head.node(id);
    if (id == first_input && features >= 0) {
      place[id] = features;
      continue;
    }
    std::vector<NodeId> inputs;
    for (const NodeId input : node.inputs) inputs.push_back(place.at(input));
    place[id] = trained.add(prefixed(kHead, node.name), node.layer, inputs);
  }
  return trained;
}

Parameters trained_parameters(const Graph& trained, const Parameters& backbone, const Graph& head, std::uint64_t seed) {
  const Parameters fresh = initial_parameters(head, seed);
  Parameters parameters;
  for (const auto& node : trained.nodes())
    for (const auto& spec : node.parameters) {
      const std::string name = node.parameter_name(spec);
      if (name.starts_with(kHead)) {
        parameters.set(name, fresh.at(name.substr(kHead.size())));
      } else {
        const Tensor copy = backbone.at(name.substr(kBackbone.size())).clone();
        parameters.set(name, spec.trainable ? copy.as_parameter() : copy);
      }
    }
  return parameters;
}

void take_trained(const Parameters& trained, Parameters& backbone, Parameters& head) {
  for (const auto& [name, value] : trained.items())
    if (name.starts_with(kHead))
      head.set(name.substr(kHead.size()), value);
    else
      backbone.set(name.substr(kBackbone.size()), value);
}

}  // namespace svnet::models
