#include "io/keras_graph.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "io/keras_weights.h"
#include "nn/graph/keras_order.h"

namespace svnet {
namespace {

/// A layer of the file that has weights, whatever the layout.
struct FileLayer {
  std::string name;
  std::vector<KerasArray> arrays;
};

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
  const std::string stem = snake_case(kind(layer));
  if (!name.starts_with(stem)) return false;
  const std::string rest = name.substr(stem.size());
  return rest.empty() || (rest.size() > 1 && rest[0] == '_' && rest.find_first_not_of("0123456789", 1) == rest.npos);
}

std::vector<FileLayer> legacy_layers(const std::filesystem::path& path) {
  std::vector<FileLayer> layers;
  for (auto& layer : read_keras_weights(path))
    if (!layer.arrays.empty()) layers.push_back({layer.name, std::move(layer.arrays)});
  return layers;
}

/// The layers of a Keras 3 file in the order of the graph's: the k-th of a class in the file is the k-th of that class
/// in Keras' order. What the graph has no place for comes last.
std::vector<FileLayer> keras3_layers(const std::filesystem::path& path, const Graph& graph,
                                     const std::vector<NodeId>& order) {
  std::map<std::string, std::vector<FileLayer>> by_class;
  auto read = read_keras3_weights(path);
  std::stable_sort(read.begin(), read.end(), [](const auto& a, const auto& b) { return a.counter < b.counter; });
  for (auto& layer : read)
    if (!layer.arrays.empty()) by_class[layer.class_name].push_back({layer.path, std::move(layer.arrays)});
  std::map<std::string, std::size_t> used;
  std::vector<FileLayer> layers;
  for (NodeId id : order) {
    const std::string class_name = snake_case(kind(graph.node(id).layer));
    auto& candidates = by_class[class_name];
    std::size_t& next = used[class_name];
    check(next < candidates.size(), path.string(), ": there are ", candidates.size(), " layers of class '", class_name,
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
  for (const auto& array : arrays) texts.push_back(to_string(array.shape));
  return joined_with(", ", texts);
}

std::string shapes_of(const std::vector<ParameterSpec>& specs) {
  std::vector<std::string> texts;
  for (const auto& spec : specs) texts.push_back(spec.name + " " + to_string(spec.shape));
  return joined_with(", ", texts);
}

void fill(const std::filesystem::path& path, std::size_t position, const GraphNode& node, FileLayer& layer,
          Parameters& parameters) {
  for (std::size_t i = 0; i < std::min(layer.arrays.size(), node.parameters.size()); ++i) {
    const std::string own = own_name(layer.arrays[i].name);
    for (const auto& other : node.parameters)
      check(other.name != own || own == node.parameters[i].name, path.string(), ": layer '", layer.name, "' has its '",
            own, "' where '", node.parameters[i].name, "' belongs; the weights of a layer must be in Keras' order");
  }
  bool fits = layer.arrays.size() == node.parameters.size();
  for (std::size_t i = 0; fits && i < layer.arrays.size(); ++i)
    fits = layer.arrays[i].shape == node.parameters[i].shape;
  check(fits, path.string(), ": layer ", position + 1, " is '", layer.name, "' with ", shapes_of(layer.arrays),
        ", the model expects '", node.name, "' with ", shapes_of(node.parameters),
        "; these are weights of another model");
  for (std::size_t i = 0; i < layer.arrays.size(); ++i) {
    const ParameterSpec& spec = node.parameters[i];
    Tensor value = Tensor::from(spec.shape, layer.arrays[i].values);
    parameters.set(node.parameter_name(spec), spec.trainable ? value.as_parameter() : value);
    layer.arrays[i].values = {};
  }
}

Parameters filled(const std::filesystem::path& path, std::vector<FileLayer> layers, const Graph& graph,
                  const std::vector<NodeId>& order, KerasLoadReport* report) {
  Parameters parameters;
  KerasLoadReport made;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (i >= order.size()) {
      made.unused.push_back(layers[i].name);
      continue;
    }
    const GraphNode& node = graph.node(order[i]);
    const std::string& name = layers[i].name;
    check(name == node.name || is_automatic_name(name, node.layer) || !graph.contains(name), path.string(), ": layer ",
          i + 1, " is '", name, "' where the model has '", node.name,
          "'; the layers of the file are not in the order of the model");
    fill(path, i, node, layers[i], parameters);
    made.loaded.push_back(node.name);
  }
  // Last, because weights of another model are better told by their first layer that does not fit.
  std::vector<std::string> missing;
  for (std::size_t i = layers.size(); i < order.size(); ++i) missing.push_back(graph.node(order[i]).name);
  check(missing.empty(), path.string(), ": has ", layers.size(), " layers with weights, the model needs ", order.size(),
        "; missing: ", joined_with(", ", missing));
  if (report != nullptr) *report = std::move(made);
  return parameters;
}

}  // namespace

Parameters read_keras_parameters(const std::filesystem::path& path, const Graph& graph, NodeId output,
                                 KerasLoadReport* report) {
  const auto order = weighted_layers(graph, output);
  auto layers = keras_layout(path) == KerasLayout::legacy ? legacy_layers(path) : keras3_layers(path, graph, order);
  return filled(path, std::move(layers), graph, order, report);
}

Backbone read_backbone(const std::string& name, const std::filesystem::path& weights, const std::string& layer,
                       KerasLoadReport* report) {
  const BackboneKind& kind = backbone_kind(name);
  Graph with_top = kind.graph(kind.preprocessing.height, true);
  const auto whole = weighted_layers(with_top, with_top.output());
  const bool legacy = keras_layout(weights) == KerasLayout::legacy;
  // A file has a top if it has as many layers with weights as the network with its top.
  auto layers = legacy ? legacy_layers(weights) : std::vector<FileLayer>{};
  std::size_t count = layers.size();
  if (!legacy)
    for (const auto& l : read_keras3_weights(weights)) count += l.arrays.empty() ? 0 : 1;
  Graph graph = count >= whole.size() ? std::move(with_top) : kind.graph(kind.preprocessing.height, false);
  const auto order = weighted_layers(graph, graph.output());
  if (!legacy) layers = keras3_layers(weights, graph, order);
  Parameters parameters = filled(weights, std::move(layers), graph, order, report);
  return {kind, std::move(graph), std::move(parameters), layer};
}

std::filesystem::path find_weights(const BackboneKind& kind, const std::filesystem::path& folder) {
  for (const auto& name : kind.weight_files)
    if (std::filesystem::path path = folder / name; std::filesystem::exists(path)) return path;
  fail(folder.string(), ": no weights of ", kind.name,
       "; put one of these files there: ", joined_with(", ", kind.weight_files));
}

}  // namespace svnet
