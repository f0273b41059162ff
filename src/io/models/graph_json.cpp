#include "io/models/graph_json.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "nn/graph/layer_fields.h"

namespace svnet {
namespace {

using nlohmann::json;

// One table of names per enumeration, read both ways.
constexpr std::array<std::pair<Activation, const char*>, 5> kActivations{{{Activation::none, "linear"},
                                                                          {Activation::relu, "relu"},
                                                                          {Activation::relu6, "relu6"},
                                                                          {Activation::sigmoid, "sigmoid"},
                                                                          {Activation::softmax, "softmax"}}};
constexpr std::array<std::pair<PoolKind, const char*>, 2> kPools{
    {{PoolKind::max, "max"}, {PoolKind::average, "average"}}};
constexpr std::array<std::pair<ops::MomentumConvention, const char*>, 2> kConventions{
    {{ops::MomentumConvention::keras, "keras"}, {ops::MomentumConvention::pytorch, "pytorch"}}};

constexpr const auto& names_of(Activation) { return kActivations; }
constexpr const auto& names_of(PoolKind) { return kPools; }
constexpr const auto& names_of(ops::MomentumConvention) { return kConventions; }

template <class T>
json to_json_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    for (const auto& [known, name] : names_of(value))
      if (known == value) return name;
    return nullptr;
  } else if constexpr (std::is_same_v<T, Padding>) {
    if (value.kind == Padding::Kind::valid) return "valid";
    if (value.kind == Padding::Kind::same) return "same";
    return json::array({value.top, value.bottom, value.left, value.right});
  } else {
    return value;
  }
}

template <class T>
void from_json_value(const json& value, T& to) {
  if constexpr (std::is_enum_v<T>) {
    const auto text = value.get<std::string>();
    for (const auto& [known, name] : names_of(to))
      if (text == name) {
        to = known;
        return;
      }
    fail("unknown value '", text, "'");
  } else if constexpr (std::is_same_v<T, Padding>) {
    if (value == "valid") {
      to = Padding::valid();
    } else if (value == "same") {
      to = Padding::same();
    } else {
      const auto sizes = value.get<std::array<Index, 4>>();
      to = Padding::of(sizes[0], sizes[1], sizes[2], sizes[3]);
    }
  } else {
    value.get_to(to);
  }
}

/// A default layer of the kind that `name` names.
template <std::size_t... I>
Layer layer_of_kind(const std::string& name, std::index_sequence<I...>) {
  std::vector<Layer> layers{std::variant_alternative_t<I, Layer>{}...};
  layers.emplace_back(Pool2dLayer{.kind = PoolKind::average});
  layers.emplace_back(GlobalPool2dLayer{.kind = PoolKind::max});
  std::vector<std::string> known;
  for (auto& layer : layers) {
    if (name == kind(layer)) return layer;
    known.emplace_back(kind(layer));
  }
  fail("unknown kind of layer '", name, "'", suggestion(name, known));
}

NodeId add_node(const json& node, Graph& graph) {
  Layer layer =
      layer_of_kind(node.at("kind").get<std::string>(), std::make_index_sequence<std::variant_size_v<Layer>>());
  std::visit(
      [&](auto& l) {
        visit_fields(l, [&](const char* field, auto& member) {
          try {
            from_json_value(node.at(field), member);
          } catch (const std::exception& error) {
            fail("attribute '", field, "': ", error.what());
          }
        });
      },
      layer);
  std::vector<NodeId> inputs;
  for (const auto& input : node.at("inputs")) inputs.push_back(graph.find(input.get<std::string>()));
  return graph.add(node.at("name").get<std::string>(), std::move(layer), std::move(inputs));
}

}  // namespace

json graph_to_json(const Graph& graph) {
  json nodes = json::array();
  for (const auto& node : graph.nodes()) {
    json out{{"name", node.name}, {"kind", kind(node.layer)}, {"inputs", json::array()}};
    for (NodeId id : node.inputs) out["inputs"].push_back(graph.node(id).name);
    std::visit(
        [&](const auto& layer) {
          visit_fields(layer, [&](const char* field, const auto& member) { out[field] = to_json_value(member); });
        },
        node.layer);
    nodes.push_back(std::move(out));
  }
  return nodes;
}

Graph graph_from_json(const json& nodes, const std::string& where) {
  check(nodes.is_array() && !nodes.empty(), where, ": the graph is not a list of nodes");
  Graph graph;
  for (std::size_t i = 0; i < nodes.size(); ++i) try {
      add_node(nodes[i], graph);
    } catch (const std::exception& error) {
      const bool named = nodes[i].is_object() && nodes[i].contains("name") && nodes[i]["name"].is_string();
      fail(where, ": node ", i, named ? " '" + nodes[i]["name"].get<std::string>() + "'" : std::string(), ": ",
           error.what());
    }
  return graph;
}

}  // namespace svnet
