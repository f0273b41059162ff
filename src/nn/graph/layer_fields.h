#pragma once
#include "nn/graph/layer.h"

namespace svnet {

// The attributes of each layer by name, once for everyone who reads or writes them: visit_fields(layer, field) calls
// field("name", layer.member) for each. Files hold them under these names.

template <class Windowed, class Field>
void visit_window(Windowed& l, Field& field) {
  field("kernel_height", l.kh);
  field("kernel_width", l.kw);
  field("stride_height", l.stride_h);
  field("stride_width", l.stride_w);
  field("padding", l.padding);
}

template <class L, class Field>
void visit_fields(L& l, Field&& field) {
  using Type = std::remove_const_t<L>;
  if constexpr (std::is_same_v<Type, InputLayer> || std::is_same_v<Type, ReshapeLayer>) {
    field("shape", l.shape);
  } else if constexpr (std::is_same_v<Type, Conv2dLayer> || std::is_same_v<Type, DepthwiseConv2dLayer> ||
                       std::is_same_v<Type, SeparableConv2dLayer>) {
    if constexpr (!std::is_same_v<Type, DepthwiseConv2dLayer>) field("filters", l.filters);
    if constexpr (!std::is_same_v<Type, Conv2dLayer>) field("multiplier", l.multiplier);
    visit_window(l, field);
    field("bias", l.bias);
    field("activation", l.activation);
  } else if constexpr (std::is_same_v<Type, DenseLayer>) {
    field("units", l.units);
    field("bias", l.bias);
    field("activation", l.activation);
  } else if constexpr (std::is_same_v<Type, BatchNormLayer>) {
    field("momentum", l.options.momentum);
    field("epsilon", l.options.epsilon);
    field("convention", l.options.convention);
  } else if constexpr (std::is_same_v<Type, ActivationLayer>) {
    field("activation", l.activation);
  } else if constexpr (std::is_same_v<Type, Pool2dLayer>) {
    field("pool", l.kind);
    visit_window(l.window, field);
  } else if constexpr (std::is_same_v<Type, GlobalPool2dLayer>) {
    field("pool", l.kind);
    field("keep_dimensions", l.keep_dimensions);
  } else if constexpr (std::is_same_v<Type, ZeroPadding2dLayer>) {
    field("padding", l.padding);
  } else if constexpr (std::is_same_v<Type, DropoutLayer>) {
    field("rate", l.rate);
  }
}

}  // namespace svnet
