#include "io/models/graph_json.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/enum_names.h"
#include "nn/layers/layer.h"

namespace svnet::io {
namespace {

using nlohmann::json;

template <class T>
json to_json_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (std::is_same_v<T, Padding>) {
    if (value.kind != Padding::Kind::explicit_) return name_of(value.kind);
    return json::array({value.top, value.bottom, value.left, value.right});
  } else {
    return value;
  }
}

template <class T>
void from_json_value(const json& value, T& to) {
  if constexpr (std::is_enum_v<T>) {
    to = enum_from_name<T>("unknown value", value.get<std::string>());
  } else if constexpr (std::is_same_v<T, Padding>) {
    if (value.is_string()) {
      to = {.kind = enum_from_name<Padding::Kind>("unknown value", value.get<std::string>())};
      check(to.kind != Padding::Kind::explicit_, "explicit padding is a list of four numbers");
    } else {
      const auto sizes = value.get<std::array<Index, 4>>();
      to = Padding::of(sizes[0], sizes[1], sizes[2], sizes[3]);
    }
  } else {
    value.get_to(to);
  }
}

NodeId add_node(const json& node, Graph& graph) {
  Layer layer = layer_of_class(node.at("kind").get<std::string>());
  std::visit(
      [&](auto& l) {
        l.visit(l, [&](const char* field, auto& member) {
          try {
            from_json_value(node.at(field), member);
          } catch (const std::bad_alloc&) {
            throw;
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
    json out{{"name", node.name}, {"kind", keras_name(node.layer)}, {"inputs", json::array()}};
    for (NodeId id : node.inputs) out["inputs"].push_back(graph.node(id).name);
    std::visit(
        [&](const auto& layer) {
          layer.visit(layer, [&](const char* field, const auto& member) { out[field] = to_json_value(member); });
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
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      const bool named = nodes[i].is_object() && nodes[i].contains("name") && nodes[i]["name"].is_string();
      fail(where, ": node ", i, named ? " '" + nodes[i]["name"].get<std::string>() + "'" : std::string(), ": ",
           error.what());
    }
  return graph;
}

}  // namespace svnet::io
