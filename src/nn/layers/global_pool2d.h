#pragma once
#include "nn/layers/pool_kind.h"
#include "nn/layers/shapes.h"

namespace svnet {

/// (H, W, C) -> (C), or (1, 1, C) if the dimensions are kept.
struct GlobalPool2dLayer {
  PoolKind kind = PoolKind::average;
  bool keep_dimensions = false;

  const char* keras_name() const { return kind == PoolKind::max ? "GlobalMaxPooling2D" : "GlobalAveragePooling2D"; }
  static std::vector<GlobalPool2dLayer> keras_classes() {
    return {{.kind = PoolKind::max}, {.kind = PoolKind::average}};
  }
  std::vector<ParameterSpec> parameters(const Shapes&) const { return {}; }
  Shape output_shape(const Shapes& inputs) const {
    const Index channels = only_images(keras_name(), inputs).back();
    return keep_dimensions ? Shape{1, 1, channels} : Shape{channels};
  }
  static void visit(auto& layer, auto&& field) {
    field("pool", layer.kind);
    field("keep_dimensions", layer.keep_dimensions);
  }
};

}  // namespace svnet
