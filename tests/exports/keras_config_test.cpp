#include "io/keras/keras_config.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

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

TEST_CASE("a layer that Keras cannot describe is refused by name") {
  Graph graph;
  graph.add("conv", Conv2dLayer{.filters = 2, .padding = Padding::of(1, 1, 1, 1)}, {graph.input("image", {4, 4, 3})});
  CHECK_THROWS_WITH(keras_config(graph), "[keras] layer 'conv': Keras has no explicit padding for this layer");
}

TEST_CASE("a configuration of another kind is refused") {
  CHECK_THROWS_WITH(graph_of_keras_config(nlohmann::json{{"config", 3}}, "config.json"), Contains("config.json: "));
}
