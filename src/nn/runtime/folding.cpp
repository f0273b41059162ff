#include "nn/runtime/folding.h"

#include <cmath>
#include <optional>

namespace svnet {
namespace {

/// A layer that produces (…, K) by a kernel whose last axis, or last two together, are the K channels.
template <class L>
constexpr bool kProducer = std::is_same_v<L, Conv2dLayer> || std::is_same_v<L, DepthwiseConv2dLayer> ||
                           std::is_same_v<L, SeparableConv2dLayer> || std::is_same_v<L, DenseLayer>;

/// The name of the parameter that scales with the output channels.
const char* last_kernel(const Layer& layer) {
  if (std::holds_alternative<DepthwiseConv2dLayer>(layer)) return "depthwise_kernel";
  return std::holds_alternative<SeparableConv2dLayer>(layer) ? "pointwise_kernel" : "kernel";
}

/// The one node that reads `id`, if it is one and `id` is not an output.
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

/// One producer and what is folded into it.
struct Chain {
  NodeId producer, last;
  std::optional<NodeId> norm;
  Activation activation = Activation::none;
};

Chain chain_from(const Graph& graph, const std::vector<bool>& needed, NodeId id, NodeId output) {
  Chain chain{.producer = id, .last = id, .norm = {}};
  const bool active = std::visit(
      [](const auto& l) {
        if constexpr (kProducer<std::decay_t<decltype(l)>>)
          return l.activation != Activation::none;
        else
          return true;
      },
      graph.node(id).layer);
  if (active) return chain;
  auto next = only_reader(graph, needed, id, output);
  if (next && std::holds_alternative<BatchNormLayer>(graph.node(*next).layer)) {
    chain.norm = chain.last = *next;
    next = only_reader(graph, needed, *next, output);
  }
  if (next)
    if (const auto* layer = graph.node(*next).as<ActivationLayer>();
        layer != nullptr && (layer->activation == Activation::relu || layer->activation == Activation::relu6)) {
      chain.activation = layer->activation;
      chain.last = *next;
    }
  return chain;
}

/// kernel (…, K) · scale (K) and bias · scale + shift, with scale = gamma / √(variance + ε), in double.
void fold_norm(const GraphNode& norm, const Parameters& from, const std::string& kernel_name,
               const std::string& bias_name, Parameters& to) {
  const double epsilon = std::get<BatchNormLayer>(norm.layer).options.epsilon;
  const auto value = [&](const char* name, Index c) {
    return static_cast<double>(from.at(norm.name + "/" + name).data<float>()[c]);
  };
  Tensor kernel = to.at(kernel_name).clone();
  const Index channels = norm.parameters[0].shape[0], rows = kernel.size() / channels;
  Tensor bias = to.contains(bias_name) ? to.at(bias_name).clone() : Tensor::zeros({channels});
  for (Index c = 0; c < channels; ++c) {
    const double scale = value("gamma", c) / std::sqrt(value("moving_variance", c) + epsilon);
    for (Index row = 0; row < rows; ++row) {
      float& w = kernel.data<float>()[row * channels + c];
      w = static_cast<float>(w * scale);
    }
    float& b = bias.data<float>()[c];
    b = static_cast<float>((b - value("moving_mean", c)) * scale + value("beta", c));
  }
  to.set(kernel_name, kernel);
  to.set(bias_name, bias);
}

}  // namespace

FoldedGraph folded(const Graph& graph, const Parameters& parameters, NodeId output) {
  const auto needed = graph.ancestors({output});
  std::vector<NodeId> place(needed.size(), -1);  // of each original node's value in the result
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
          if constexpr (kProducer<std::decay_t<decltype(l)>>) {
            if (chain.norm) {
              fold_norm(graph.node(*chain.norm), parameters, name + "/" + last_kernel(node.layer), name + "/bias",
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
