#pragma once
#include "nn/layers/shapes.h"

namespace svnet {

/// The elementwise product of two inputs of one shape, or of images (H, W, C) with a factor per channel, (1, 1, C) or
/// (C), in either order.
struct MultiplyLayer {
  const char* keras_name() const { return "Multiply"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    check(inputs.size() == 2, "[Multiply] takes two inputs, got ", inputs.size());
    const bool swapped = is_factor(inputs[1], inputs[0]);
    check(swapped || inputs[0] == inputs[1] || is_factor(inputs[0], inputs[1]),
          "[Multiply] expects one shape, or HxWxC and 1x1xC or C, got ", to_string(inputs[0]), " and ",
          to_string(inputs[1]));
    return inputs[swapped ? 1 : 0];
  }
  static void visit(auto&, auto&&) {}

  /// Whether `factor` holds one factor per channel of images.
  static bool is_factor(const Shape& images, const Shape& factor) {
    if (images.size() != 3) return false;
    return factor == Shape{1, 1, images[2]} || factor == Shape{images[2]};
  }
};

}  // namespace svnet
