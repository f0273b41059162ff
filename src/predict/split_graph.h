#pragma once
#include <optional>
#include <string>

#include "nn/runtime/folding.h"

namespace svnet::predict {

/// A graph that is cut where its second input, the angles of a pose, meets the first, the picture, so that one picture
/// can be combined with many poses at little cost:
///   c = once(picture),  h = relu(c + angles · angle_kernel),  y = relu(h · kernel + bias),
///   z = y · last_kernel + last_bias,  output = rest(z)
struct SplitGraph {
  FoldedGraph once;     ///< output (units)
  Tensor angle_kernel;  ///< (angles, units)
  Tensor kernel;        ///< (units, n)
  Tensor bias;          ///< (n), or an empty handle
  std::string layer;    ///< the name of the layer with `kernel`
  Tensor last_kernel;   ///< (n, m)
  Tensor last_bias;     ///< (m), or an empty handle
  FoldedGraph rest;     ///< reads (m)
};

/// Cuts a graph of two inputs in which everything that depends on the first one leads into one concatenation with the
/// second one, and that into three dense layers, the first two with ReLU and the third without an activation. Batch
/// norms are folded first (runtime/folding.h); dropout between these layers is left out. Values agree with those of the
/// whole graph up to rounding. Returns nothing if the graph has another form.
std::optional<SplitGraph> split_graph(const Graph& graph, const Parameters& parameters, NodeId output);

}  // namespace svnet::predict
