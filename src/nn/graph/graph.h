#pragma once
#include <string>
#include <variant>
#include <vector>

#include "nn/layers/layer.h"

namespace svnet {

/// Position of a node in Graph::nodes().
using NodeId = int;

struct GraphNode {
  std::string name;  // Keras' layer name where the model has one
  Layer layer;
  std::vector<NodeId> inputs;
  Shape shape;  // of the output, without the batch
  std::vector<ParameterSpec> parameters;

  /// The layer if it is of that kind, else nullptr.
  template <class L>
  const L* as() const {
    return std::get_if<L>(&layer);
  }
  template <class L>
  bool is() const {
    return as<L>() != nullptr;
  }

  /// "name/kernel": how a parameter is called in Parameters and in files.
  std::string parameter_name(const ParameterSpec& spec) const { return name + "/" + spec.name; }
};

/// The description of a model: named layers, in an order in which every layer follows its inputs. It holds no numbers.
/// Training runs it through ops, io fills its parameters from files and writes it down.
class Graph {
 public:
  NodeId input(std::string name, Shape shape) { return add(std::move(name), InputLayer{std::move(shape)}, {}); }
  /// Infers the output shape. Throws Error where shapes do not fit or the name is taken.
  NodeId add(std::string name, Layer layer, std::vector<NodeId> inputs);

  const std::vector<GraphNode>& nodes() const { return nodes_; }
  const GraphNode& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  bool contains(const std::string& name) const;
  /// Throws Error naming the nearest layer where there is none of that name.
  NodeId find(const std::string& name) const;
  /// The input nodes in order of creation: the order in which running takes tensors.
  std::vector<NodeId> inputs() const;
  /// The last node added.
  NodeId output() const { return static_cast<NodeId>(nodes_.size()) - 1; }
  /// Which nodes `outputs` depend on, themselves included.
  std::vector<bool> ancestors(const std::vector<NodeId>& outputs) const;
  /// The graph without the nodes that `output` does not need; the output is the last node.
  Graph up_to(NodeId output) const;
  /// Number of parameters' elements.
  Index parameter_count() const;

 private:
  std::vector<GraphNode> nodes_;
};

}  // namespace svnet
