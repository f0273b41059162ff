#include "nn/graph/keras_order.h"

#include <catch2/catch.hpp>

using namespace svnet;

namespace {

std::vector<std::string> names(const Graph& graph, NodeId output) {
  std::vector<std::string> all;
  for (NodeId id : keras_order(graph, output)) all.push_back(graph.node(id).name);
  return all;
}

}  // namespace

// The orders are those of [layer.name for layer in model.layers] of Keras 3.15.1 for the same models.
TEST_CASE("layers come in the order of Keras' model.layers") {
  Graph graph;
  const auto conv = [&](const std::string& name, NodeId x) {
    x = graph.add(name, Conv2dLayer{.filters = 6, .kh = 3, .kw = 3, .padding = Padding::same()}, {x});
    return graph.add(name + "_bn", BatchNormLayer{}, {x});
  };
  const NodeId image = graph.input("image", {8, 8, 3}), angles = graph.input("angles", {2});
  NodeId x = conv("stem", image);
  NodeId shortcut = graph.add("short1", Conv2dLayer{.filters = 6, .stride_h = 2, .stride_w = 2}, {x});
  shortcut = graph.add("short1_bn", BatchNormLayer{}, {shortcut});
  x = conv("a2", conv("a1", x));
  x = graph.add("pool1", Pool2dLayer{.window = {3, 3, 2, 2, Padding::same()}}, {x});
  x = graph.add("add1", AddLayer{}, {x, shortcut});
  const NodeId block = conv("b1", x);
  shortcut = graph.add("short2", Conv2dLayer{.filters = 6}, {x});
  const NodeId add2 = x = graph.add("add2", AddLayer{}, {shortcut, block});
  x = graph.add("gap", GlobalPool2dLayer{}, {x});
  x = graph.add("join", ConcatLayer{}, {x, angles});
  x = graph.add("score", DenseLayer{}, {x});
  const std::vector<std::string> block2{"image", "stem",      "stem_bn", "a1", "a1_bn",  "a2",    "a2_bn", "short1",
                                        "pool1", "short1_bn", "add1",    "b1", "short2", "b1_bn", "add2"};
  CHECK(names(graph, add2) == block2);
  std::vector<std::string> whole = block2;
  whole.insert(whole.end(), {"gap", "angles", "join", "score"});
  CHECK(names(graph, x) == whole);
}

TEST_CASE("layers of one depth are in the order in which a walk from the output meets them") {
  // Keras: a = Input, s = Dense(a), l = Dense(a), r = Dense(a), y = Add([r, Add([l, s])]).
  Graph graph;
  const NodeId a = graph.input("a", {4});
  const auto dense = [&](const char* name) { return graph.add(name, DenseLayer{.units = 4}, {a}); };
  const NodeId s = dense("s"), l = dense("l"), r = dense("r");
  const NodeId inner = graph.add("inner", AddLayer{}, {l, s});
  CHECK(names(graph, graph.add("y", AddLayer{}, {r, inner})) ==
        std::vector<std::string>{"a", "l", "s", "r", "inner", "y"});
}
