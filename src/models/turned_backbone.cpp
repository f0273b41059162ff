#include "models/turned_backbone.h"

namespace svnet::models {
namespace {

constexpr Index kPlaces = 3;  // along each side

NodeId add_projection(Graph& graph, NodeId from, Index components) {
  return graph.add("projection", DenseLayer{.units = components}, {from});
}

}  // namespace

Graph pooled_graph(const Graph& backbone) {
  Graph graph = backbone;
  NodeId x = graph.output();
  const Shape shape = graph.node(x).shape;
  if (shape.size() == 1) return graph;
  if (shape.size() == 3 && shape[0] >= kPlaces && shape[1] >= kPlaces) {
    const Index down = shape[0] / kPlaces, across = shape[1] / kPlaces;
    x = graph.add("places",
                  Pool2dLayer{.kind = PoolKind::average,
                              .window = {.kh = shape[0] - (kPlaces - 1) * down,
                                         .kw = shape[1] - (kPlaces - 1) * across,
                                         .stride_h = down,
                                         .stride_w = across}},
                  {x});
  }
  graph.add("pooled", FlattenLayer{}, {x});
  return graph;
}

Graph projected_graph(const Graph& pooled, Index components) {
  Graph graph = pooled;
  add_projection(graph, graph.output(), components);
  return graph;
}

Graph projection_graph(Index inputs, Index components) {
  Graph graph;
  add_projection(graph, graph.input("pooled", {inputs}), components);
  return graph;
}

}  // namespace svnet::models
