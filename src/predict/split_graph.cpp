#include "predict/split_graph.h"

#include <algorithm>
#include <vector>

namespace svnet::predict {
namespace {

std::size_t at(NodeId id) { return static_cast<std::size_t>(id); }

/// Where a folded graph is cut: the concatenation and three dense layers. Only dropout lies between them.
struct Cut {
  NodeId concat, first, second, third;
};

std::vector<NodeId> readers_of(const Graph& graph, NodeId id) {
  std::vector<NodeId> readers;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i)
    for (const NodeId input : graph.nodes()[i].inputs)
      if (input == id) readers.push_back(static_cast<NodeId>(i));
  return readers;
}

/// The dense layer that alone reads `id`, past dropout, if it has that activation.
std::optional<NodeId> dense_after(const Graph& graph, NodeId id, Activation activation) {
  for (auto readers = readers_of(graph, id); readers.size() == 1; readers = readers_of(graph, id)) {
    id = readers[0];
    if (const auto* dense = graph.node(id).as<DenseLayer>())
      return dense->activation == activation ? std::optional(id) : std::nullopt;
    if (!graph.node(id).is<DropoutLayer>()) return {};
  }
  return {};
}

/// For each node whether it depends on `input`.
std::vector<bool> dependents(const Graph& graph, NodeId input) {
  std::vector<bool> depends(graph.nodes().size(), false);
  depends[at(input)] = true;
  for (std::size_t i = 0; i < depends.size(); ++i)
    for (const NodeId from : graph.nodes()[i].inputs) depends[i] = depends[i] || depends[at(from)];
  return depends;
}

std::optional<Cut> cut_of(const Graph& graph, const std::vector<bool>& of_picture, NodeId angles) {
  const auto readers = readers_of(graph, angles);
  if (readers.size() != 1 || !graph.node(readers[0]).is<ConcatLayer>()) return {};
  const NodeId concat = readers[0];
  for (const NodeId input : graph.node(concat).inputs)
    if (input != angles && !of_picture[at(input)]) return {};
  // Whatever depends on the picture and not on the angles reaches the output through the concatenation alone.
  const std::vector<bool> after = dependents(graph, concat);
  for (std::size_t i = 0; i < after.size(); ++i)
    if (after[i] && static_cast<NodeId>(i) != concat)
      for (const NodeId input : graph.nodes()[i].inputs)
        if (!after[at(input)]) return {};
  const auto first = dense_after(graph, concat, Activation::relu);
  const auto second = first ? dense_after(graph, *first, Activation::relu) : std::nullopt;
  const auto third = second ? dense_after(graph, *second, Activation::none) : std::nullopt;
  if (!third) return {};
  return Cut{concat, *first, *second, *third};
}

/// A graph while it is built from nodes of the whole one.
class Part {
 public:
  explicit Part(const FoldedGraph& whole) : whole_(whole), place_(whole.graph.nodes().size(), -1) {}

  /// The value of a node of the whole graph as an input.
  void input(NodeId id) { place_[at(id)] = part_.graph.input(whole_.graph.node(id).name, whole_.graph.node(id).shape); }

  void copy(NodeId id) {
    const GraphNode& node = whole_.graph.node(id);
    place_[at(id)] = part_.graph.add(node.name, node.layer, placed(node.inputs));
    for (const auto& spec : node.parameters)
      part_.parameters.set(node.parameter_name(spec), whole_.parameters.at(node.parameter_name(spec)));
  }

  std::vector<NodeId> placed(const std::vector<NodeId>& ids) const {
    std::vector<NodeId> places;
    for (const NodeId id : ids) places.push_back(place_[at(id)]);
    return places;
  }

  FoldedGraph& result() { return part_; }

 private:
  const FoldedGraph& whole_;
  FoldedGraph part_{};
  std::vector<NodeId> place_;  // of each node of the whole graph; -1 if it has none
};

/// The rows of the kernel of a dense layer that read those inputs of the concatenation for which `taken` holds.
template <class Taken>
Tensor rows_of(const FoldedGraph& whole, const Cut& cut, Taken taken) {
  const Tensor& kernel = whole.parameters.at(whole.graph.node(cut.first).name + "/kernel");
  const Index units = kernel.dim(1);
  std::vector<float> rows;
  const float* from = kernel.data<float>();
  for (const NodeId id : whole.graph.node(cut.concat).inputs) {
    const float* const end = from + whole.graph.node(id).shape.back() * units;
    if (taken(id)) rows.insert(rows.end(), from, end);
    from = end;
  }
  Tensor result = Tensor::empty({static_cast<Index>(rows.size()) / units, units});
  std::ranges::copy(rows, result.data<float>());
  return result;
}

Tensor bias_of(const FoldedGraph& whole, NodeId dense) {
  const std::string name = whole.graph.node(dense).name + "/bias";
  return whole.parameters.contains(name) ? whole.parameters.at(name) : Tensor();
}

FoldedGraph once_part(const FoldedGraph& whole, const Cut& cut, NodeId angles) {
  Part part(whole);
  const GraphNode &concat = whole.graph.node(cut.concat), &dense = whole.graph.node(cut.first);
  const std::vector<bool> needed = whole.graph.ancestors(concat.inputs);
  for (NodeId id = 0; id < cut.concat; ++id)
    if (needed[at(id)] && id != angles) part.copy(id);
  std::vector<NodeId> inputs = concat.inputs;
  std::erase(inputs, angles);
  FoldedGraph& once = part.result();
  std::vector<NodeId> from = part.placed(inputs);
  if (from.size() > 1) from = {once.graph.add(concat.name, ConcatLayer{}, from)};
  const Tensor bias = bias_of(whole, cut.first);
  once.graph.add(dense.name, DenseLayer{.units = std::get<DenseLayer>(dense.layer).units, .bias = bias.defined()},
                 from);
  once.parameters.set(dense.name + "/kernel", rows_of(whole, cut, [&](NodeId id) { return id != angles; }));
  if (bias.defined()) once.parameters.set(dense.name + "/bias", bias);
  // A reference, which would be copied otherwise.
  // cppcheck-suppress returnStdMoveLocal
  return std::move(once);
}

FoldedGraph rest_part(const FoldedGraph& whole, const Cut& cut) {
  Part part(whole);
  part.input(cut.third);
  const std::vector<bool> after = dependents(whole.graph, cut.third);
  for (NodeId id = cut.third + 1; id <= whole.graph.output(); ++id)
    if (after[at(id)]) part.copy(id);
  return std::move(part.result());
}

}  // namespace

std::optional<SplitGraph> split_graph(const Graph& graph, const Parameters& parameters, NodeId output) {
  const FoldedGraph whole = folded(graph, parameters, output);
  const std::vector<NodeId> inputs = whole.graph.inputs();
  if (inputs.size() != 2 || whole.graph.node(inputs[0]).name != graph.node(graph.inputs()[0]).name) return {};
  const NodeId angles = inputs[1];
  const auto cut = cut_of(whole.graph, dependents(whole.graph, inputs[0]), angles);
  if (!cut) return {};
  const auto kernel = [&](NodeId id) { return whole.parameters.at(whole.graph.node(id).name + "/kernel"); };
  return SplitGraph{.once = once_part(whole, *cut, angles),
                    .angle_kernel = rows_of(whole, *cut, [&](NodeId id) { return id == angles; }),
                    .kernel = kernel(cut->second),
                    .bias = bias_of(whole, cut->second),
                    .layer = whole.graph.node(cut->second).name,
                    .last_kernel = kernel(cut->third),
                    .last_bias = bias_of(whole, cut->third),
                    .rest = rest_part(whole, *cut)};
}

}  // namespace svnet::predict
