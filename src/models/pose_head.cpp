#include "models/pose_head.h"

#include "models/layers.h"

namespace svnet::models {
namespace {

NodeId add_network(Graph& g, NodeId pose, const std::string& prefix, const PoseNetworkOptions& options) {
  NodeId x = pose;
  for (const char* number : {"1", "2"}) {
    x = g.add(prefix + "dense" + number, DenseLayer{.units = options.width}, {x});
    x = activation(g, prefix + "relu" + number, x, Activation::relu);
    if (options.dropout > 0) x = g.add(prefix + "dropout" + number, DropoutLayer{options.dropout}, {x});
  }
  return g.add(prefix + "out", DenseLayer{.units = 1}, {x});
}

}  // namespace

Graph linear_head(Index inputs) {
  Graph g;
  NodeId x = g.input("pose", {inputs});
  x = g.add("ridge", DenseLayer{.units = 1}, {x});
  activation(g, "score", x, Activation::sigmoid);
  return g;
}

Graph pose_network(Index inputs, const PoseNetworkOptions& options) {
  Graph g;
  add_network(g, g.input("pose", {inputs}), "", options);
  return g;
}

std::string network_prefix(Index number) { return "network" + std::to_string(number) + "_"; }

Graph mixed_head(Index inputs, Index networks, const PoseNetworkOptions& options) {
  Graph g;
  const NodeId pose = g.input("pose", {inputs});
  std::vector<NodeId> parts{g.add("ridge", DenseLayer{.units = 1}, {pose})};
  for (Index i = 1; i <= networks; ++i) parts.push_back(add_network(g, pose, network_prefix(i), options));
  const NodeId all = g.add("parts", ConcatLayer{}, parts);
  activation(g, "score", g.add("mean", DenseLayer{.units = 1}, {all}), Activation::sigmoid);
  return g;
}

}  // namespace svnet::models
