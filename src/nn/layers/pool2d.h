#pragma once
#include "nn/layers/pool_kind.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (H, W, C) -> (OH, OW, C).
struct Pool2dLayer {
  PoolKind kind = PoolKind::max;
  WindowOptions window{};

  const char* keras_name() const { return kind == PoolKind::max ? "MaxPooling2D" : "AveragePooling2D"; }
  static std::vector<Pool2dLayer> keras_classes() { return {{.kind = PoolKind::max}, {.kind = PoolKind::average}}; }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    return window_output(keras_name(), inputs, window, channels_of(inputs));
  }
  static void visit(auto& layer, auto&& field) {
    field("pool", layer.kind);
    visit_window(layer.window, field);
  }
};

}  // namespace svnet
