#include "io/keras/keras_match.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "io/keras/snake_case.h"

namespace svnet::io {
namespace {

/// Whether Keras made the name by itself, from the layer's class and a counter ("conv2d", "conv2d_7"): such a name says
/// nothing about the layer's place.
bool is_automatic_name(const std::string& name, const Layer& layer) {
  const std::string stem = snake_case(keras_name(layer));
  if (!name.starts_with(stem)) return false;
  const std::string rest = name.substr(stem.size());
  return rest.empty() || (rest.size() > 1 && rest[0] == '_' && rest.find_first_not_of("0123456789", 1) == rest.npos);
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

/// Why the layer of the file, the `position`-th of its model, is not `node`; empty if it fits.
std::string misfit(const Graph& graph, const GraphNode& node, const KerasLayer& layer, std::size_t position) {
  const std::string& name = layer.model.empty() ? layer.path : layer.layer_name;
  if (name != node.name && !is_automatic_name(name, node.layer) && graph.contains(name))
    return joined("layer ", position + 1, " is '", layer.path, "' where the model has '", node.name,
                  "'; the layers of the file are not in the order of the model");
  for (std::size_t i = 0; i < std::min(layer.arrays.size(), node.parameters.size()); ++i) {
    const std::string own = own_name(layer.arrays[i].name);
    for (const auto& other : node.parameters)
      if (other.name == own && own != node.parameters[i].name)
        return joined("layer '", layer.path, "' has its '", own, "' where '", node.parameters[i].name,
                      "' belongs; the weights of a layer must be in Keras' order");
  }
  bool fits = layer.arrays.size() == node.parameters.size();
  for (std::size_t i = 0; fits && i < layer.arrays.size(); ++i)
    fits = layer.arrays[i].shape == node.parameters[i].shape;
  if (fits) return {};
  return joined("layer ", position + 1, " is '", layer.path, "' with ", shapes_of(layer.arrays),
                ", the model expects '", node.name, "' with ", shapes_of(node.parameters),
                "; these are weights of another model");
}

/// Takes layers out of a list, in the order of a graph's.
class Taking {
 public:
  explicit Taking(std::vector<KerasLayer> layers) : layers_(std::move(layers)) {}

  template <class Wanted>
  bool take(const Wanted& wanted) {
    const auto found = std::find_if(layers_.begin(), layers_.end(), wanted);
    if (found == layers_.end()) return false;
    taken_.push_back(std::move(*found));
    layers_.erase(found);
    return true;
  }
  /// Those taken, then the others.
  std::vector<KerasLayer> all() && {
    taken_.insert(taken_.end(), std::make_move_iterator(layers_.begin()), std::make_move_iterator(layers_.end()));
    return std::move(taken_);
  }
  std::size_t taken() const { return taken_.size(); }

 private:
  std::vector<KerasLayer> layers_, taken_;
};

/// The k-th layer of a class in the file is the k-th of that class in Keras' order.
void arrange_by_class(KerasMatch& match, const Graph& graph, const std::vector<NodeId>& order) {
  std::stable_sort(match.layers.begin(), match.layers.end(),
                   [](const auto& a, const auto& b) { return a.counter < b.counter; });
  std::map<std::string, std::size_t> in_file;
  for (const KerasLayer& layer : match.layers) ++in_file[layer.class_name];
  Taking taking(std::move(match.layers));
  for (NodeId id : order) {
    const std::string class_name = snake_case(keras_name(graph.node(id).layer));
    if (taking.take([&](const KerasLayer& layer) { return layer.class_name == class_name; })) continue;
    match.problem = joined("there are ", in_file[class_name], " layers of class '", class_name, "', and layer '",
                           graph.node(id).name, "' of the model needs one more");
    break;
  }
  match.fitting = taking.taken();
  match.layers = std::move(taking).all();
}

/// Puts the layers into the order of the graph's by their names, if all of the first `named` are found; those whose
/// names Keras made are taken in the order of the file. Keras lists the weights of a nested model that can be trained
/// before those that cannot, so layers that were frozen come last.
void arrange_by_name(KerasMatch& match, const Graph& graph, const std::vector<NodeId>& order, std::size_t named) {
  Taking taking(match.layers);
  for (NodeId id : order) {
    const GraphNode& node = graph.node(id);
    const bool automatic = is_automatic_name(node.name, node.layer);
    if (!taking.take([&](const KerasLayer& layer) {
          return automatic ? is_automatic_name(layer.layer_name, node.layer) : layer.layer_name == node.name;
        }))
      break;
  }
  if (taking.taken() >= named) match.layers = std::move(taking).all();
}

}  // namespace

std::vector<KerasMatch> keras_matches(const KerasWeightsFile& file, const Graph& graph,
                                      const std::vector<NodeId>& order, std::size_t named) {
  std::vector<KerasMatch> matches{KerasMatch{}};
  for (const KerasLayer& layer : file.layers()) {
    if (layer.arrays.empty()) continue;
    auto match = std::ranges::find(matches, layer.model, &KerasMatch::model);
    if (match == matches.end())
      match = matches.insert(matches.end(), {.model = layer.model, .layers = {}, .problem = {}});
    match->layers.push_back(layer);
  }
  for (KerasMatch& match : matches) {
    match.fitting = std::min(match.layers.size(), order.size());
    if (file.layout() == KerasLayout::keras3) arrange_by_class(match, graph, order);
    if (file.layout() == KerasLayout::legacy && !match.model.empty()) arrange_by_name(match, graph, order, named);
    for (std::size_t i = 0; i < match.fitting; ++i)
      if (std::string problem = misfit(graph, graph.node(order[i]), match.layers[i], i); !problem.empty()) {
        match.fitting = i;
        match.problem = std::move(problem);
      }
    if (match.problem.empty() && match.fitting < named) {
      std::vector<std::string> missing;
      for (std::size_t i = match.fitting; i < named; ++i) missing.push_back(graph.node(order[i]).name);
      match.problem = joined("has ", match.layers.size(), " layers with weights, the model needs ", named,
                             "; missing: ", joined_with(", ", missing));
    }
  }
  return matches;
}

}  // namespace svnet::io
