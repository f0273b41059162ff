#include "nn/runtime/folding.h"

#include <optional>
#include <vector>

#include "nn/kernels/activation/activation.h"
#include "nn/kernels/batch_norm/channel_norm.h"

namespace svnet {
namespace {

/// A layer that a batch norm and an activation can be folded into.
template <class L>
concept Producer = requires {
  L::kFoldingKernel;
};

/// The node that reads `id`, if there is exactly one and `id` is not the output.
std::optional<NodeId> only_reader(const Graph& graph, const std::vector<bool>& needed, NodeId id, NodeId output) {
  std::optional<NodeId> reader;
  if (id == output) return {};
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    for (NodeId input : graph.nodes()[i].inputs)
      if (input == id) {
        if (reader) return {};
        reader = static_cast<NodeId>(i);
      }
  }
  return reader;
}

/// A producer, and the batch norm and activation that are folded into it. `last` is the last of them.
struct Chain {
  NodeId producer, last;
  std::optional<NodeId> norm;
  Activation activation = Activation::none;
};

Chain chain_from(const Graph& graph, const std::vector<bool>& needed, NodeId id, NodeId output) {
  Chain chain{.producer = id, .last = id, .norm = {}};
  const bool keeps_alone = std::visit(
      [](const auto& l) {
        if constexpr (Producer<std::decay_t<decltype(l)>>)
          return l.activation != Activation::none;
        else
          return true;
      },
      graph.node(id).layer);
  if (keeps_alone) return chain;
  auto next = only_reader(graph, needed, id, output);
  if (next && std::holds_alternative<BatchNormLayer>(graph.node(*next).layer)) {
    chain.norm = chain.last = *next;
    next = only_reader(graph, needed, *next, output);
  }
  if (next)
    if (const auto* layer = graph.node(*next).as<ActivationLayer>();
        layer != nullptr && layer->activation != Activation::none && kernels::clamp_of(layer->activation)) {
      chain.activation = layer->activation;
      chain.last = *next;
    }
  return chain;
}

/// Multiplies kernel (…, K) by the batch norm's scale (K) and replaces bias (K) by its norm.
void fold_norm(const GraphNode& norm, const Parameters& from, const std::string& kernel_name,
               const std::string& bias_name, Parameters& to) {
  const double epsilon = std::get<BatchNormLayer>(norm.layer).options.epsilon;
  const auto value = [&](const char* name, Index c) {
    return static_cast<double>(from.at(norm.name + "/" + name).data<float>()[c]);
  };
  Tensor kernel = to.at(kernel_name).clone();
  const Index channels = norm.parameters[0].shape[0], rows = kernel.size() / channels;
  Tensor bias = to.contains(bias_name) ? to.at(bias_name).clone() : Tensor::zeros({channels});
  std::vector<double> scales;
  for (Index c = 0; c < channels; ++c) {
    const auto at_channel = kernels::channel_norm(value("gamma", c), value("beta", c), value("moving_mean", c),
                                                  value("moving_variance", c), epsilon);
    float& b = bias.data<float>()[c];
    b = static_cast<float>(at_channel(b));
    scales.push_back(at_channel.scale);
  }
  float* w = kernel.data<float>();
  for (Index row = 0; row < rows; ++row, w += channels)
    for (Index c = 0; c < channels; ++c) w[c] = static_cast<float>(w[c] * scales[static_cast<std::size_t>(c)]);
  to.set(kernel_name, kernel);
  to.set(bias_name, bias);
}

}  // namespace

FoldedGraph folded(const Graph& graph, const Parameters& parameters, NodeId output) {
  const auto needed = graph.ancestors({output});
  std::vector<NodeId> place(needed.size(), -1);  // the node of the result that has the value of each original node
  FoldedGraph result;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i] || place[i] >= 0) continue;
    const GraphNode& node = graph.nodes()[i];
    const Chain chain = chain_from(graph, needed, static_cast<NodeId>(i), output);
    const std::string name = graph.node(chain.last).name;
    Layer layer = node.layer;
    for (const auto& spec : node.parameters)
      result.parameters.set(name + "/" + spec.name, parameters.at(node.parameter_name(spec)).detached());
    std::visit(
        [&](auto& l) {
          if constexpr (Producer<std::decay_t<decltype(l)>>) {
            if (chain.norm) {
              fold_norm(graph.node(*chain.norm), parameters, name + "/" + l.kFoldingKernel, name + "/bias",
                        result.parameters);
              l.bias = true;
            }
            if (chain.activation != Activation::none) l.activation = chain.activation;
          }
        },
        layer);
    std::vector<NodeId> inputs;
    for (NodeId id : node.inputs) inputs.push_back(place[static_cast<std::size_t>(id)]);
    const NodeId made = result.graph.add(name, std::move(layer), std::move(inputs));
    place[i] = made;
    if (chain.norm) place[static_cast<std::size_t>(*chain.norm)] = made;
    place[static_cast<std::size_t>(chain.last)] = made;
  }
  return result;
}

}  // namespace svnet
