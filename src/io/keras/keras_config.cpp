#include "io/keras/keras_config.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace svnet::io {
namespace {

using nlohmann::json;

// Each layer's attributes are listed once, in `attributes` below: Writing puts them into a layer's config, Reading
// takes them from there.

class Writing {
 public:
  explicit Writing(json& config) : config_(config) {}

  template <class T>
  void operator()(const char* name, const T& value) {
    config_[name] = value;
  }
  void operator()(const char* name, Activation value) { config_[name] = name_of(value); }
  void pair(const char* name, Index first, Index second) { config_[name] = {first, second}; }
  void padding(const Padding& padding) {
    check(padding.kind != Padding::Kind::explicit_, "Keras has no explicit padding for this layer");
    config_["padding"] = name_of(padding.kind);
  }
  void zeros(const Padding& p) { config_["padding"] = {{p.top, p.bottom}, {p.left, p.right}}; }
  /// With the batch, which Keras leaves open.
  void batch_shape(const Shape& shape) {
    config_["batch_shape"] = json::array({nullptr});
    for (const Index size : shape) config_["batch_shape"].push_back(size);
  }

 private:
  json& config_;
};

class Reading {
 public:
  explicit Reading(const json& config) : config_(config) {}

  template <class T>
  void operator()(const char* name, T& value) {
    config_.at(name).get_to(value);
  }
  void operator()(const char* name, Activation& value) {
    value = enum_from_name<Activation>("unknown value", config_.at(name).get<std::string>());
  }
  void pair(const char* name, Index& first, Index& second) {
    const auto sizes = two(config_.at(name));
    first = sizes[0];
    second = sizes[1];
  }
  void padding(Padding& padding) {
    padding = {.kind = enum_from_name<Padding::Kind>("unknown padding", config_.at("padding").get<std::string>())};
  }
  void zeros(Padding& padding) {
    const json& sizes = config_.at("padding");
    check(sizes.size() == 2, "expected two sides of padding, got ", sizes.size());
    const auto rows = two(sizes.at(0)), columns = two(sizes.at(1));
    padding = Padding::of(rows[0], rows[1], columns[0], columns[1]);
  }
  void batch_shape(Shape& shape) {
    const json& sizes = config_.at("batch_shape");
    shape.clear();
    for (std::size_t i = 1; i < sizes.size(); ++i) shape.push_back(sizes[i].get<Index>());
  }

 private:
  /// nlohmann ignores what follows the last element of an array.
  static std::array<Index, 2> two(const json& sizes) {
    check(sizes.size() == 2, "expected two sizes, got ", sizes.size());
    return sizes.get<std::array<Index, 2>>();
  }

  const json& config_;
};

void window_attributes(auto& io, auto& layer, const char* size) {
  io.pair(size, layer.kh, layer.kw);
  io.pair("strides", layer.stride_h, layer.stride_w);
  io.padding(layer.padding);
}

void product_attributes(auto& io, auto& layer) {
  io("use_bias", layer.bias);
  io("activation", layer.activation);
}

void attributes(auto& io, InputLayer& layer) { io.batch_shape(layer.shape); }
void attributes(auto& io, Conv2dLayer& layer) {
  io("filters", layer.filters);
  window_attributes(io, layer, "kernel_size");
  product_attributes(io, layer);
}
void attributes(auto& io, DepthwiseConv2dLayer& layer) {
  io("depth_multiplier", layer.multiplier);
  window_attributes(io, layer, "kernel_size");
  product_attributes(io, layer);
}
void attributes(auto& io, SeparableConv2dLayer& layer) {
  io("filters", layer.filters);
  io("depth_multiplier", layer.multiplier);
  window_attributes(io, layer, "kernel_size");
  product_attributes(io, layer);
}
void attributes(auto& io, DenseLayer& layer) {
  io("units", layer.units);
  product_attributes(io, layer);
}
void attributes(auto& io, BatchNormLayer& layer) {
  io("momentum", layer.options.momentum);
  io("epsilon", layer.options.epsilon);
}
void attributes(auto& io, ActivationLayer& layer) { io("activation", layer.activation); }
void attributes(auto& io, Pool2dLayer& layer) { window_attributes(io, layer.window, "pool_size"); }
void attributes(auto& io, GlobalPool2dLayer& layer) { io("keepdims", layer.keep_dimensions); }
void attributes(auto& io, ZeroPadding2dLayer& layer) { io.zeros(layer.padding); }
void attributes(auto& io, ReshapeLayer& layer) { io("target_shape", layer.shape); }
void attributes(auto& io, DropoutLayer& layer) { io("rate", layer.rate); }
void attributes(auto&, AddLayer&) {}
void attributes(auto&, MultiplyLayer&) {}
void attributes(auto&, ConcatLayer&) {}
void attributes(auto&, FlattenLayer&) {}

/// What a layer's call takes: the output of another layer.
json keras_tensor(const GraphNode& node) {
  json shape = json::array({nullptr});
  for (const Index size : node.shape) shape.push_back(size);
  return {{"class_name", "__keras_tensor__"},
          {"config", {{"shape", shape}, {"dtype", "float32"}, {"keras_history", {node.name, 0, 0}}}}};
}

bool takes_a_list(const Layer& layer) {
  return std::holds_alternative<AddLayer>(layer) || std::holds_alternative<MultiplyLayer>(layer) ||
         std::holds_alternative<ConcatLayer>(layer);
}

json layer_config(const Graph& graph, const GraphNode& node) {
  json config = {{"name", node.name}, {"dtype", "float32"}};
  try {
    Writing writing(config);
    std::visit([&](auto layer) { attributes(writing, layer); }, node.layer);
  } catch (const Error& error) {
    fail("[keras] layer '", node.name, "': ", error.what());
  }
  json inputs = json::array();
  for (const NodeId id : node.inputs) inputs.push_back(keras_tensor(graph.node(id)));
  json calls = json::array();
  if (!inputs.empty())
    calls.push_back({{"args", takes_a_list(node.layer) ? json::array({inputs}) : inputs}, {"kwargs", json::object()}});
  return {{"module", "keras.layers"}, {"class_name", keras_name(node.layer)},
          {"config", config},         {"registered_name", nullptr},
          {"name", node.name},        {"inbound_nodes", calls}};
}

/// The names of the layers that a layer's call takes.
std::vector<std::string> inputs_of(const json& layer) {
  std::vector<std::string> names;
  for (const json& call : layer.at("inbound_nodes")) {
    const json& args = call.at("args");
    for (const json& tensor : args.at(0).is_array() ? args.at(0) : args)
      names.push_back(tensor.at("config").at("keras_history").at(0).get<std::string>());
  }
  return names;
}

}  // namespace

json keras_config(const Graph& graph) {
  json layers = json::array(), inputs = json::array();
  for (const GraphNode& node : graph.nodes()) layers.push_back(layer_config(graph, node));
  for (const NodeId id : graph.inputs()) inputs.push_back({graph.node(id).name, 0, 0});
  const std::string& output = graph.node(graph.output()).name;
  return {{"module", "keras.src.models.functional"},  // as Keras itself writes it
          {"class_name", "Functional"},
          {"registered_name", "Functional"},
          {"config",
           {{"name", "svnet"},
            {"trainable", true},
            {"layers", layers},
            {"input_layers", inputs},
            {"output_layers", json::array({{output, 0, 0}})}}}};
}

Graph graph_of_keras_config(const json& config, const std::string& where) {
  Graph graph;
  try {
    for (const json& from : config.at("config").at("layers")) {
      Layer layer = layer_of_class(from.at("class_name").get<std::string>());
      Reading reading(from.at("config"));
      std::visit([&](auto& l) { attributes(reading, l); }, layer);
      std::vector<NodeId> inputs;
      for (const std::string& name : inputs_of(from)) inputs.push_back(graph.find(name));
      graph.add(from.at("name").get<std::string>(), std::move(layer), std::move(inputs));
    }
  } catch (const json::exception& error) {
    fail(where, ": ", error.what());
  } catch (const Error& error) {
    fail(where, ": ", error.what());
  }
  return graph;
}

}  // namespace svnet::io
