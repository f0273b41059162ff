#include "models/preprocessing_layer.h"

#include <vector>

namespace svnet::models {
namespace {

constexpr const char* kName = "preprocessing";

/// The 3 x 3 matrix and the bias of preprocess(), from its values at black and at one channel of value 255.
void set_affine(PixelMode mode, Parameters& parameters) {
  Tensor kernel = Tensor::empty({1, 1, 3, 3}), bias = Tensor::empty({3});
  const std::uint8_t black[3] = {0, 0, 0};
  preprocess(mode, black, 1, bias.data<float>());
  for (Index channel = 0; channel < 3; ++channel) {
    std::uint8_t rgb[3] = {0, 0, 0};
    rgb[channel] = 255;
    float at_255[3];
    preprocess(mode, rgb, 1, at_255);
    for (Index to = 0; to < 3; ++to)
      kernel.data<float>()[channel * 3 + to] = (at_255[to] - bias.data<float>()[to]) / 255;
  }
  parameters.set(joined(kName, "/kernel"), kernel);
  parameters.set(joined(kName, "/bias"), bias);
}

/// Adds the nodes of `from` to `to`, except for its first input, which becomes `first`.
void add_nodes(const Graph& from, NodeId first, Graph& to) {
  const NodeId replaced = from.inputs().at(0);
  std::vector<NodeId> place;
  for (std::size_t i = 0; i < from.nodes().size(); ++i) {
    if (static_cast<NodeId>(i) == replaced) {
      place.push_back(first);
      continue;
    }
    const GraphNode& node = from.nodes()[i];
    std::vector<NodeId> inputs;
    for (const NodeId input : node.inputs) inputs.push_back(place[static_cast<std::size_t>(input)]);
    place.push_back(to.add(node.name, node.layer, std::move(inputs)));
  }
}

}  // namespace

GraphWithParameters with_preprocessing(PixelMode mode, const Graph& graph, const Parameters& parameters) {
  GraphWithParameters result;
  const GraphNode& input = graph.node(graph.inputs().at(0));
  const NodeId image = result.graph.input(input.name, input.shape);
  add_nodes(graph, result.graph.add(kName, Conv2dLayer{.filters = 3}, {image}), result.graph);
  set_affine(mode, result.parameters);
  for (const auto& [name, value] : parameters.items()) result.parameters.set(name, value);
  return result;
}

Graph joined_graph(const Graph& backbone, const Graph& head) {
  Graph result = backbone;
  const NodeId last = result.output();
  const bool is_row = result.node(last).shape.size() == 1;
  add_nodes(head, is_row ? last : result.add("features", FlattenLayer{}, {last}), result);
  return result;
}

}  // namespace svnet::models
