#include "io/keras/keras_model_folder.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/files/atomic_file.h"
#include "io/files/whole_file.h"
#include "io/hdf5/hdf5_file.h"
#include "io/keras/keras_config.h"
#include "io/keras/snake_case.h"
#include "nn/graph/keras_order.h"

namespace svnet::io {
namespace {

using nlohmann::json;

/// The layers with weights, and the groups of their arrays: "layers/conv2d_1/vars". Keras counts the layers of a class
/// in the order of model.layers.
std::vector<std::pair<NodeId, std::string>> groups_of(const Graph& graph) {
  std::vector<std::pair<NodeId, std::string>> groups;
  std::map<std::string, int> count;
  for (const NodeId id : keras_order(graph, graph.output())) {
    const std::string name = snake_case(keras_name(graph.node(id).layer));
    const int number = count[name]++;
    if (graph.node(id).parameters.empty()) continue;
    groups.emplace_back(id, joined("layers/", name, number == 0 ? "" : joined("_", number), "/vars"));
  }
  return groups;
}

std::string array_name(const std::string& group, std::size_t i) { return joined(group, "/", i); }

}  // namespace

void write_keras_model(const std::filesystem::path& folder, const Graph& graph, const Parameters& parameters) {
  write_atomically(folder / "config.json", keras_config(graph).dump(1));
  // The version of Keras whose format this is; Keras does not check it.
  write_atomically(folder / "metadata.json", json{{"keras_version", "3.0.0"}}.dump(1));
  Hdf5File file = Hdf5File::create(folder / "model.weights.h5");
  for (const auto& [id, group] : groups_of(graph)) {
    const GraphNode& node = graph.node(id);
    file.create_group(group);
    file.write_text_attribute(group, "name", node.name);
    for (std::size_t i = 0; i < node.parameters.size(); ++i) {
      const Tensor& value = parameters.at(node.parameter_name(node.parameters[i]));
      file.write<float>(array_name(group, i), value.shape(), value.values<float>());
    }
  }
  file.close();
}

KerasModel read_keras_model(const std::filesystem::path& folder) {
  const std::filesystem::path config = folder / "config.json";
  json description;
  try {
    description = json::parse(whole_file(config));
  } catch (const json::exception& error) {
    fail(config.string(), ": ", error.what());
  }
  KerasModel model{.graph = graph_of_keras_config(description, config.string()), .parameters = {}};
  const Hdf5File file = Hdf5File::open(folder / "model.weights.h5");
  for (const auto& [id, group] : groups_of(model.graph)) {
    const GraphNode& node = model.graph.node(id);
    for (std::size_t i = 0; i < node.parameters.size(); ++i) {
      const Hdf5Array<float> array = file.read<float>(array_name(group, i));
      check(array.shape == node.parameters[i].shape, file.name(), ": ", array_name(group, i), " is ",
            to_string(array.shape), ", expected ", to_string(node.parameters[i].shape));
      model.parameters.set(node.parameter_name(node.parameters[i]), Tensor::from(array.shape, array.values));
    }
  }
  return model;
}

}  // namespace svnet::io
