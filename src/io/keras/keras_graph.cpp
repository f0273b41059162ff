#include "io/keras/keras_graph.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "io/keras/keras_weights.h"
#include "nn/graph/keras_order.h"

namespace svnet {
namespace {

/// The nodes with parameters that `output` needs, in Keras' order.
std::vector<NodeId> weighted_layers(const Graph& graph, NodeId output) {
  std::vector<NodeId> layers = keras_order(graph, output);
  std::erase_if(layers, [&](NodeId id) { return graph.node(id).parameters.empty(); });
  return layers;
}

/// "SeparableConv2D" -> "separable_conv2d", as Keras makes layer names of class names.
std::string snake_case(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool upper = name[i] >= 'A' && name[i] <= 'Z';
    const bool next_lower = i + 1 < name.size() && name[i + 1] >= 'a' && name[i + 1] <= 'z';
    const bool after_lower = i > 0 && name[i - 1] >= 'a' && name[i - 1] <= 'z';
    if (upper && i > 0 && (after_lower || next_lower)) text += '_';
    text += upper ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  return text;
}

/// Whether Keras made the name by itself, from the layer's class and a counter ("conv2d", "conv2d_7"): such a name says
/// nothing about the layer's place.
bool is_automatic_name(const std::string& name, const Layer& layer) {
  const std::string stem = snake_case(keras_name(layer));
  if (!name.starts_with(stem)) return false;
  const std::string rest = name.substr(stem.size());
  return rest.empty() || (rest.size() > 1 && rest[0] == '_' && rest.find_first_not_of("0123456789", 1) == rest.npos);
}

/// The layers of the file that have weights.
std::vector<KerasLayer> weighted_layers(const KerasWeightsFile& file) {
  std::vector<KerasLayer> layers = file.layers();
  std::erase_if(layers, [](const KerasLayer& layer) { return layer.arrays.empty(); });
  return layers;
}

/// The layers of a Keras 3 file in the order of the graph's: the k-th of a class in the file is the k-th of that class
/// in Keras' order. What the graph has no place for comes last.
std::vector<KerasLayer> in_order_of(const Graph& graph, const std::vector<NodeId>& order, const std::string& file,
                                    std::vector<KerasLayer> read) {
  std::map<std::string, std::vector<KerasLayer>> by_class;
  std::stable_sort(read.begin(), read.end(), [](const auto& a, const auto& b) { return a.counter < b.counter; });
  for (auto& layer : read) by_class[layer.class_name].push_back(std::move(layer));
  std::map<std::string, std::size_t> used;
  std::vector<KerasLayer> layers;
  for (NodeId id : order) {
    const std::string class_name = snake_case(keras_name(graph.node(id).layer));
    auto& candidates = by_class[class_name];
    std::size_t& next = used[class_name];
    check(next < candidates.size(), file, ": there are ", candidates.size(), " layers of class '", class_name,
          "', and layer '", graph.node(id).name, "' of the model needs one more");
    layers.push_back(std::move(candidates[next++]));
  }
  for (auto& [name, candidates] : by_class)
    for (std::size_t i = used[name]; i < candidates.size(); ++i) layers.push_back(std::move(candidates[i]));
  return layers;
}

/// "gamma" of "conv1_bn/gamma:0".
std::string own_name(const std::string& array) {
  const std::string last = array.substr(array.find_last_of('/') + 1);
  return last.substr(0, last.find(':'));
}

std::string shapes_of(const std::vector<KerasArray>& arrays) {
  std::vector<std::string> texts;
  texts.reserve(arrays.size());
  for (const auto& array : arrays) texts.push_back(to_string(array.shape));
  return joined_with(", ", texts);
}

std::string shapes_of(const std::vector<ParameterSpec>& specs) {
  std::vector<std::string> texts;
  texts.reserve(specs.size());
  for (const auto& spec : specs) texts.push_back(spec.name + " " + to_string(spec.shape));
  return joined_with(", ", texts);
}

void check_fits(const std::string& file, std::size_t position, const GraphNode& node, const KerasLayer& layer) {
  for (std::size_t i = 0; i < std::min(layer.arrays.size(), node.parameters.size()); ++i) {
    const std::string own = own_name(layer.arrays[i].name);
    for (const auto& other : node.parameters)
      check(other.name != own || own == node.parameters[i].name, file, ": layer '", layer.path, "' has its '", own,
            "' where '", node.parameters[i].name, "' belongs; the weights of a layer must be in Keras' order");
  }
  bool fits = layer.arrays.size() == node.parameters.size();
  for (std::size_t i = 0; fits && i < layer.arrays.size(); ++i)
    fits = layer.arrays[i].shape == node.parameters[i].shape;
  check(fits, file, ": layer ", position + 1, " is '", layer.path, "' with ", shapes_of(layer.arrays),
        ", the model expects '", node.name, "' with ", shapes_of(node.parameters),
        "; these are weights of another model");
}

/// Checks every layer of `order` against the file, and reads the numbers of those that `output` needs.
Parameters matched(const KerasWeightsFile& file, const Graph& graph, const std::vector<NodeId>& order, NodeId output,
                   KerasLoadReport* report) {
  std::vector<KerasLayer> layers = weighted_layers(file);
  if (file.layout() == KerasLayout::keras3) layers = in_order_of(graph, order, file.name(), std::move(layers));
  const std::vector<bool> needed = graph.ancestors({output});
  KerasLoadReport made;
  std::vector<std::pair<const GraphNode*, const KerasLayer*>> to_load;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string& name = layers[i].path;
    if (i >= order.size()) {
      made.unused.push_back(name);
      continue;
    }
    const GraphNode& node = graph.node(order[i]);
    check(name == node.name || is_automatic_name(name, node.layer) || !graph.contains(name), file.name(), ": layer ",
          i + 1, " is '", name, "' where the model has '", node.name,
          "'; the layers of the file are not in the order of the model");
    check_fits(file.name(), i, node, layers[i]);
    if (needed[static_cast<std::size_t>(order[i])]) {
      to_load.emplace_back(&node, &layers[i]);
      made.loaded.push_back(node.name);
    } else {
      made.unused.push_back(name);
    }
  }
  // Last, because weights of another model are better told by their first layer that does not fit.
  std::vector<std::string> missing;
  for (std::size_t i = layers.size(); i < order.size(); ++i) missing.push_back(graph.node(order[i]).name);
  check(missing.empty(), file.name(), ": has ", layers.size(), " layers with weights, the model needs ", order.size(),
        "; missing: ", joined_with(", ", missing));
  Parameters parameters;
  for (const auto& [node, layer] : to_load)
    for (std::size_t i = 0; i < layer->arrays.size(); ++i) {
      const ParameterSpec& spec = node->parameters[i];
      const Tensor value = Tensor::from(spec.shape, file.values(layer->arrays[i]));
      parameters.set(node->parameter_name(spec), spec.trainable ? value.as_parameter() : value);
    }
  if (report != nullptr) *report = std::move(made);
  return parameters;
}

}  // namespace

Backbone read_keras_backbone(const std::string& name, const std::filesystem::path& weights, const std::string& layer,
                             KerasLoadReport* report, const InferenceOptions& options) {
  const BackboneKind& kind = backbone_kind(name);
  const KerasWeightsFile file(weights);
  Graph graph = kind.graph(kind.preprocessing.height, true);
  auto order = weighted_layers(graph, graph.output());
  // A file has a top if it has as many layers with weights as the network with its top.
  if (weighted_layers(file).size() < order.size()) {
    graph = kind.graph(kind.preprocessing.height, false);
    order = weighted_layers(graph, graph.output());
  }
  const NodeId output = output_layer(kind, graph, layer);
  return {kind, graph, matched(file, graph, order, output, report), layer, options};
}

}  // namespace svnet
