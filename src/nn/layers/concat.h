#pragma once
#include <algorithm>

#include "nn/layers/shapes.h"

namespace svnet {

/// Two inputs or more (…, C1), (…, C2), … -> (…, C1 + C2 + …).
struct ConcatLayer {
  const char* keras_name() const { return "Concatenate"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    check(inputs.size() >= 2, "[Concatenate] takes two inputs or more, got ", inputs.size());
    Shape shape = inputs[0];
    check(!shape.empty(), "[Concatenate] expects at least one axis");
    shape.back() = 0;
    for (const Shape& part : inputs) {
      check(part.size() == shape.size() && std::equal(shape.begin(), shape.end() - 1, part.begin()),
            "[Concatenate] shapes differ before the last axis: ", to_string(inputs[0]), " and ", to_string(part));
      shape.back() += part.back();
    }
    return shape;
  }
  static void visit(auto&, auto&&) {}
};

}  // namespace svnet
