#include "models/pose_head.h"

#include "models/layers.h"

namespace svnet::models {

Graph linear_head(Index inputs) {
  Graph g;
  NodeId x = g.input("pose", {inputs});
  x = g.add("ridge", DenseLayer{.units = 1}, {x});
  activation(g, "score", x, Activation::sigmoid);
  return g;
}

}  // namespace svnet::models
