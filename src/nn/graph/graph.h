#pragma once
#include <string>
#include <variant>
#include <vector>

#include "nn/layers/layer.h"

namespace svnet {

/// Position of a node in Graph::nodes().
using NodeId = int;

struct GraphNode {
  std::string name;  // Keras' layer name if the model has one
  Layer layer;
  std::vector<NodeId> inputs;
  Shape shape;  // of the output, without the batch
  std::vector<ParameterSpec> parameters;

  /// The layer if it is an L, else nullptr.
  template <class L>
  const L* as() const {
    return std::get_if<L>(&layer);
  }
  template <class L>
  bool is() const {
    return as<L>() != nullptr;
  }

  /// The name of a parameter in Parameters and in files: "name/kernel".
  std::string parameter_name(const ParameterSpec& spec) const { return name + "/" + spec.name; }
};

/// The description of a model: named layers, each after its inputs. It has no weights; those are in Parameters. run.h
/// runs it, runtime/ compiles it, io reads and writes it.
class Graph {
 public:
  NodeId input(std::string name, Shape shape) { return add(std::move(name), InputLayer{std::move(shape)}, {}); }
  /// Adds a layer and infers its output shape. Throws Error if shapes do not fit, or if the name is empty or taken.
  NodeId add(std::string name, Layer layer, std::vector<NodeId> inputs);

  const std::vector<GraphNode>& nodes() const { return nodes_; }
  const GraphNode& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  bool contains(const std::string& name) const;
  /// Throws Error with the nearest name if there is no such layer.
  NodeId find(const std::string& name) const;
  /// The input nodes in order of creation, in which running takes its tensors.
  std::vector<NodeId> inputs() const;
  /// The last node added.
  NodeId output() const { return static_cast<NodeId>(nodes_.size()) - 1; }
  /// For each node whether one of `outputs` depends on it. The outputs are included.
  std::vector<bool> ancestors(const std::vector<NodeId>& outputs) const;
  /// Only the nodes that `output` depends on; it becomes the last node.
  Graph up_to(NodeId output) const;
  /// The number of elements of all parameters.
  Index parameter_count() const;

 private:
  std::vector<GraphNode> nodes_;
};

}  // namespace svnet
