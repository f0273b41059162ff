#include "io/keras/keras_graph.h"

#include <algorithm>

#include "base/text.h"
#include "io/keras/keras_match.h"
#include "nn/graph/keras_order.h"

namespace svnet::io {
namespace {

/// The nodes with parameters that `output` needs, in Keras' order.
std::vector<NodeId> weighted_layers(const Graph& graph, NodeId output) {
  std::vector<NodeId> layers = keras_order(graph, output);
  std::erase_if(layers, [&](NodeId id) { return graph.node(id).parameters.empty(); });
  return layers;
}

std::string model_text(const KerasMatch& match) {
  return match.model.empty() ? "the file's own" : "'" + printable(match.model) + "'";
}

/// The one match of which at least `least` layers fit. Throws Error if there is none or several.
KerasMatch only_fit(const std::string& file, std::vector<KerasMatch> matches, std::size_t least) {
  std::vector<std::string> fits;
  for (const KerasMatch& match : matches)
    if (match.fitting >= least) fits.push_back(model_text(match));
  check(fits.size() < 2, file, ": holds ", fits.size(), " models that fit (", joined_with(", ", fits),
        "); save the one that is meant into a file of its own");
  KerasMatch best = std::move(*std::ranges::max_element(matches, {}, &KerasMatch::fitting));
  check(!fits.empty(), file, ": ", best.problem);
  return best;
}

/// The layers of the file that are not in `match`, and those of `match` from `first` on.
std::vector<std::string> other_layers(const KerasWeightsFile& file, const KerasMatch& match, std::size_t first) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < match.layers.size(); ++i) names.push_back(match.layers[i].path);
  for (const KerasLayer& layer : file.layers())
    if (!layer.arrays.empty() && layer.model != match.model) names.push_back(layer.path);
  return names;
}

/// Reads the numbers of the layers of `order` that `output` needs.
Parameters read_parameters(const KerasWeightsFile& file, const Graph& graph, const std::vector<NodeId>& order,
                           const KerasMatch& match, NodeId output, KerasLoadReport* report) {
  const std::vector<bool> needed = graph.ancestors({output});
  KerasLoadReport made;
  Parameters parameters;
  const std::size_t count = std::min(order.size(), match.fitting);
  for (std::size_t i = 0; i < count; ++i) {
    const GraphNode& node = graph.node(order[i]);
    const KerasLayer& layer = match.layers[i];
    if (!needed[static_cast<std::size_t>(order[i])]) {
      made.unused.push_back(layer.path);
      continue;
    }
    made.loaded.push_back(node.name);
    for (std::size_t k = 0; k < layer.arrays.size(); ++k) {
      const ParameterSpec& spec = node.parameters[k];
      const Tensor value = Tensor::from(spec.shape, file.values(layer.arrays[k]));
      parameters.set(node.parameter_name(spec), spec.trainable ? value.as_parameter() : value);
    }
  }
  std::ranges::move(other_layers(file, match, count), std::back_inserter(made.unused));
  if (report != nullptr) *report = std::move(made);
  return parameters;
}

/// Whether the output of `layer` needs only layers that fit.
bool is_within(const Graph& graph, const std::vector<NodeId>& order, std::size_t fitting, const std::string& layer) {
  const std::vector<bool> needed = graph.ancestors({graph.find(layer)});
  return std::none_of(order.begin() + static_cast<std::ptrdiff_t>(fitting), order.end(),
                      [&](NodeId id) { return needed[static_cast<std::size_t>(id)]; });
}

}  // namespace

models::Backbone read_keras_backbone(const std::string& name, const std::filesystem::path& weights,
                                     const std::string& layer, KerasLoadReport* report,
                                     const InferenceOptions& options) {
  const models::BackboneKind& kind = models::backbone_kind(name);
  const KerasWeightsFile file(weights);
  const Graph whole = kind.graph(kind.preprocessing.height, true), base = kind.graph(kind.preprocessing.height, false);
  const std::vector<NodeId> order = weighted_layers(whole, whole.output());
  const std::size_t base_layers = weighted_layers(base, base.output()).size();
  const KerasMatch match = only_fit(file.name(), keras_matches(file, whole, order, base_layers), base_layers);

  // The top is there if all of it fits, or as much of it as `layer` needs.
  bool top = match.fitting == order.size();
  if (!top && match.layers.size() > base_layers && whole.contains(layer) && !base.contains(layer)) {
    check(is_within(whole, order, match.fitting, layer), file.name(), ": ", match.problem);
    top = true;
  }
  const Graph& graph = top ? whole : base;
  const NodeId output = output_layer(kind, graph, layer);
  const Parameters parameters =
      read_parameters(file, graph, weighted_layers(graph, graph.output()), match, output, report);
  return {kind, graph, parameters, layer, options};
}

}  // namespace svnet::io
