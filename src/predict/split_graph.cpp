#include "predict/split_graph.h"

#include <algorithm>
#include <vector>

namespace svnet::predict {
namespace {

/// Where a folded graph is cut. Only dropout lies between the two.
struct Cut {
  NodeId concat, dense;
};

std::size_t at(NodeId id) { return static_cast<std::size_t>(id); }

/// For each node whether it depends on `input`.
std::vector<bool> dependents(const Graph& graph, NodeId input) {
  std::vector<bool> depends(graph.nodes().size(), false);
  depends[at(input)] = true;
  for (std::size_t i = 0; i < depends.size(); ++i)
    for (const NodeId from : graph.nodes()[i].inputs) depends[i] = depends[i] || depends[at(from)];
  return depends;
}

/// For each node whether `first` is the only input that it depends on.
std::vector<bool> depend_on_first_alone(const Graph& graph, NodeId first) {
  std::vector<bool> alone = dependents(graph, first);
  for (const NodeId input : graph.inputs()) {
    if (input == first) continue;
    const std::vector<bool> others = dependents(graph, input);
    for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = alone[i] && !others[i];
  }
  return alone;
}

std::vector<NodeId> readers_of(const Graph& graph, NodeId id) {
  std::vector<NodeId> readers;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i)
    for (const NodeId input : graph.nodes()[i].inputs)
      if (input == id) readers.push_back(static_cast<NodeId>(i));
  return readers;
}

std::optional<Cut> cut_of(const Graph& graph, const std::vector<bool>& alone) {
  std::optional<NodeId> concat;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const auto& inputs = graph.nodes()[i].inputs;
    if (alone[i] || std::none_of(inputs.begin(), inputs.end(), [&](NodeId id) { return alone[at(id)]; })) continue;
    if (concat || !graph.nodes()[i].is<ConcatLayer>()) return {};
    concat = static_cast<NodeId>(i);
  }
  if (!concat) return {};
  NodeId last = *concat;
  for (auto readers = readers_of(graph, last); readers.size() == 1; readers = readers_of(graph, last)) {
    last = readers[0];
    if (graph.node(last).is<DenseLayer>()) return Cut{*concat, last};
    if (!graph.node(last).is<DropoutLayer>()) return {};
  }
  return {};
}

/// One of the two graphs while it is built from nodes of the whole one.
class Part {
 public:
  explicit Part(const FoldedGraph& whole) : whole_(whole), place_(whole.graph.nodes().size(), -1) {}

  void copy(NodeId id) {
    const GraphNode& node = whole_.graph.node(id);
    place_[at(id)] = part_.graph.add(node.name, node.layer, placed(node.inputs));
    for (const auto& spec : node.parameters)
      part_.parameters.set(node.parameter_name(spec), whole_.parameters.at(node.parameter_name(spec)));
  }

  /// The rows of the dense layer that read those inputs of the concatenation for which `taken` is as given. Returns its
  /// node.
  NodeId add_rows(const Cut& cut, const std::vector<bool>& alone, bool taken, bool with_bias) {
    const GraphNode& concat = whole_.graph.node(cut.concat);
    const GraphNode& dense = whole_.graph.node(cut.dense);
    const Tensor& kernel = whole_.parameters.at(dense.name + "/kernel");
    const Index units = kernel.dim(1);
    std::vector<NodeId> inputs;
    Index taken_rows = 0;
    for (const NodeId id : concat.inputs)
      if (alone[at(id)] == taken) {
        inputs.push_back(id);
        taken_rows += whole_.graph.node(id).shape.back();
      }
    Tensor rows = Tensor::empty({taken_rows, units});
    const float* in = kernel.data<float>();
    float* out = rows.data<float>();
    for (const NodeId id : concat.inputs) {
      const Index size = whole_.graph.node(id).shape.back() * units;
      if (alone[at(id)] == taken) out = std::copy_n(in, size, out);
      in += size;
    }
    std::vector<NodeId> from = placed(inputs);
    if (from.size() > 1) from = {part_.graph.add(concat.name, ConcatLayer{}, from)};
    const bool has_bias = with_bias && std::get<DenseLayer>(dense.layer).bias;
    part_.parameters.set(dense.name + "/kernel", rows);
    if (has_bias) part_.parameters.set(dense.name + "/bias", whole_.parameters.at(dense.name + "/bias"));
    return part_.graph.add(dense.name, DenseLayer{.units = units, .bias = has_bias}, from);
  }

  void put(NodeId whole, NodeId part) { place_[at(whole)] = part; }
  Graph& graph() { return part_.graph; }
  FoldedGraph taken() && { return std::move(part_); }

 private:
  std::vector<NodeId> placed(const std::vector<NodeId>& ids) const {
    std::vector<NodeId> places;
    for (const NodeId id : ids) places.push_back(place_[at(id)]);
    return places;
  }

  const FoldedGraph& whole_;
  FoldedGraph part_{};
  std::vector<NodeId> place_;  // of each node of the whole graph; -1 if it has none
};

FoldedGraph once_part(const FoldedGraph& whole, const Cut& cut, const std::vector<bool>& alone) {
  Part part(whole);
  for (NodeId id = 0; id < cut.concat; ++id)
    if (alone[at(id)]) part.copy(id);
  part.add_rows(cut, alone, true, true);
  return std::move(part).taken();
}

FoldedGraph each_part(const FoldedGraph& whole, const Cut& cut, const std::vector<bool>& alone) {
  const GraphNode& dense = whole.graph.node(cut.dense);
  Part part(whole);
  const NodeId once = part.graph().input(dense.name + " of the first input", dense.shape);
  for (NodeId id = 0; id <= whole.graph.output(); ++id) {
    if (alone[at(id)] || (id >= cut.concat && id < cut.dense && dependents(whole.graph, cut.concat)[at(id)])) continue;
    if (id != cut.dense) {
      part.copy(id);
      continue;
    }
    const NodeId others = part.add_rows(cut, alone, false, false);
    NodeId sum = part.graph().add(dense.name + " of all inputs", AddLayer{}, {others, once});
    if (const Activation activation = std::get<DenseLayer>(dense.layer).activation; activation != Activation::none)
      sum = part.graph().add(dense.name + " activation", ActivationLayer{activation}, {sum});
    part.put(id, sum);
  }
  return std::move(part).taken();
}

}  // namespace

std::optional<SplitGraph> split_graph(const Graph& graph, const Parameters& parameters, NodeId output) {
  const FoldedGraph whole = folded(graph, parameters, output);
  const std::vector<NodeId> inputs = whole.graph.inputs();
  if (inputs.empty() || whole.graph.node(inputs[0]).name != graph.node(graph.inputs()[0]).name) return {};
  const std::vector<bool> alone = depend_on_first_alone(whole.graph, inputs[0]);
  const auto cut = cut_of(whole.graph, alone);
  if (!cut) return {};
  return SplitGraph{once_part(whole, *cut, alone), each_part(whole, *cut, alone)};
}

}  // namespace svnet::predict
