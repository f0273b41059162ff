#pragma once
#include <algorithm>

#include "nn/layers/shapes.h"

namespace svnet {

/// (H, W, C) -> (top + H + bottom, left + W + right, C). The padding must be explicit.
struct ZeroPadding2dLayer {
  Padding padding{};

  const char* keras_name() const { return "ZeroPadding2D"; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    const Shape& input = only_images(keras_name(), inputs);
    const auto [least, most] = std::minmax({padding.top, padding.bottom, padding.left, padding.right});
    check(padding.kind == Padding::Kind::explicit_ && least >= 0,
          "[ZeroPadding2D] needs four numbers of zeros, none negative");
    check(most < kLargestWindow, "[ZeroPadding2D] ", most, " zeros are too many");
    return {padding.top + input[0] + padding.bottom, padding.left + input[1] + padding.right, input[2]};
  }
  static void visit(auto& layer, auto&& field) { field("padding", layer.padding); }
};

}  // namespace svnet
