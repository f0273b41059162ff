#include "nn/graph/graph.h"

#include "base/text.h"

namespace svnet {

NodeId Graph::add(std::string name, Layer layer, std::vector<NodeId> inputs) {
  check(!name.empty() && !contains(name), "[graph] layer name '", name, "' is empty or taken");
  std::vector<Shape> shapes;
  for (NodeId id : inputs) {
    check(id >= 0 && id < static_cast<NodeId>(nodes_.size()), "[graph] layer '", name, "' takes node ", id,
          ", which does not exist");
    shapes.push_back(node(id).shape);
  }
  GraphNode node{
      .name = std::move(name), .layer = std::move(layer), .inputs = std::move(inputs), .shape = {}, .parameters = {}};
  try {
    node.shape = output_shape(node.layer, shapes);
  } catch (const Error& error) {
    fail("[graph] layer '", node.name, "': ", error.what());
  }
  node.parameters = parameters(node.layer, shapes);
  nodes_.push_back(std::move(node));
  return output();
}

bool Graph::contains(const std::string& name) const {
  for (const auto& node : nodes_)
    if (node.name == name) return true;
  return false;
}

NodeId Graph::find(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].name == name) return static_cast<NodeId>(i);
    names.push_back(nodes_[i].name);
  }
  fail("[graph] no layer '", name, "'", suggestion(name, names));
}

std::vector<NodeId> Graph::inputs() const {
  std::vector<NodeId> ids;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (std::holds_alternative<InputLayer>(nodes_[i].layer)) ids.push_back(static_cast<NodeId>(i));
  return ids;
}

std::vector<bool> Graph::ancestors(const std::vector<NodeId>& outputs) const {
  std::vector<bool> needed(nodes_.size(), false);
  for (NodeId id : outputs) needed[static_cast<std::size_t>(id)] = true;
  for (std::size_t i = nodes_.size(); i-- > 0;)
    if (needed[i])
      for (NodeId id : nodes_[i].inputs) needed[static_cast<std::size_t>(id)] = true;
  return needed;
}

Graph Graph::up_to(NodeId output) const {
  const std::vector<bool> needed = ancestors({output});
  std::vector<NodeId> place(nodes_.size(), -1);
  Graph part;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!needed[i]) continue;
    std::vector<NodeId> inputs;
    for (NodeId id : nodes_[i].inputs) inputs.push_back(place[static_cast<std::size_t>(id)]);
    place[i] = part.add(nodes_[i].name, nodes_[i].layer, std::move(inputs));
  }
  return part;
}

Index Graph::parameter_count() const {
  Index count = 0;
  for (const auto& node : nodes_)
    for (const auto& spec : node.parameters) count += element_count(spec.shape);
  return count;
}

}  // namespace svnet
