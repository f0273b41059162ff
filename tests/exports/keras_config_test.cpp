#include "io/keras/keras_config.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/models/graph_json.h"
#include "models/backbone.h"
#include "models/sv_net.h"

using namespace svnet;
using namespace svnet::io;
using Catch::Contains;

TEST_CASE("the graphs of all backbones survive a Keras configuration") {
  for (const models::BackboneKind& kind : models::backbone_kinds()) {
    CAPTURE(kind.name);
    const Graph graph = models::random_backbone(kind.name, "", 1).graph();
    CHECK(graph_to_json(graph_of_keras_config(keras_config(graph), "config.json")) == graph_to_json(graph));
  }
  const Graph head = models::sv_net({.features = 8, .width = 4});
  CHECK(graph_to_json(graph_of_keras_config(keras_config(head), "config.json")) == graph_to_json(head));
}

TEST_CASE("a layer that takes several tensors takes them as one list in Keras") {
  Graph graph;
  const NodeId image = graph.input("image", {4, 4, 3});
  graph.add("product", MultiplyLayer{}, {image, image});
  const nlohmann::json config = keras_config(graph);
  const nlohmann::json& args = config.at("config").at("layers").at(1).at("inbound_nodes").at(0).at("args");
  REQUIRE(args.size() == 1);
  CHECK(args.at(0).size() == 2);
  CHECK(graph_to_json(graph_of_keras_config(config, "config.json")) == graph_to_json(graph));
}

TEST_CASE("a layer that Keras cannot describe is refused by name") {
  Graph graph;
  graph.add("conv", Conv2dLayer{.filters = 2, .padding = Padding::of(1, 1, 1, 1)}, {graph.input("image", {4, 4, 3})});
  CHECK_THROWS_WITH(keras_config(graph), "[keras] layer 'conv': Keras has no explicit padding for this layer");
}

TEST_CASE("a configuration with a damaged layer is refused") {
  Graph graph;
  graph.add("conv", Conv2dLayer{.filters = 2}, {graph.input("image", {4, 4, 3})});
  const auto message = [&](const auto& change) {
    nlohmann::json config = keras_config(graph);
    change(config.at("config").at("layers").at(1));
    try {
      graph_of_keras_config(config, "config.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using nlohmann::json;
  REQUIRE(message([](json&) {}) == "no error");
  CHECK_THAT(message([](json& layer) { layer["class_name"] = "Conv9D"; }),
             Contains("config.json: ") && Contains("Conv9D"));
  CHECK_THAT(message([](json& layer) { layer["config"].erase("filters"); }),
             Contains("config.json: ") && Contains("'filters'"));
  CHECK_THAT(message([](json& layer) { layer["config"]["activation"] = "gelou"; }),
             Contains("config.json: unknown value: 'gelou' is none of linear, relu, "));
  CHECK_THAT(message([](json& layer) { layer["config"]["padding"] = "circular"; }),
             Contains("config.json: unknown padding: 'circular' is none of valid, same"));
  CHECK_THAT(message([](json& layer) { layer["inbound_nodes"][0]["args"][0]["config"]["keras_history"][0] = "imag"; }),
             Contains("config.json: ") && Contains("'imag'"));
  CHECK_THAT(message([](json& layer) { layer["config"]["kernel_size"] = json::array({3}); }),
             Contains("config.json: expected two sizes, got 1"));
  CHECK_THAT(message([](json& layer) {
               layer["config"]["kernel_size"] = {3, 3, 3};
             }),
             Contains("config.json: expected two sizes, got 3"));
}

TEST_CASE("a configuration of another kind is refused") {
  CHECK_THROWS_WITH(graph_of_keras_config(nlohmann::json{{"config", 3}}, "config.json"), Contains("config.json: "));
}
