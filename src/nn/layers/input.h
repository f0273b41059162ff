#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// Where a tensor of the given shape enters the graph.
struct InputLayer {
  Shape shape{};

  const char* keras_name() const { return "InputLayer"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes&) const { return shape; }
  static void visit(auto& layer, auto&& field) { field("shape", layer.shape); }
};

}  // namespace svnet
