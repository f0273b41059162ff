#pragma once
#include <string>
#include <variant>
#include <vector>

#include "nn/graph/initializer.h"
#include "nn/kernels/window.h"
#include "nn/ops/batch_norm.h"
#include "nn/tensor.h"

namespace svnet {

// What a node of a Graph does: the attributes of each kind of layer, named as in Keras. Shapes leave out the batch.

enum class Activation { none, relu, relu6, sigmoid, softmax };

struct InputLayer {
  Shape shape{};
};

/// kernel (KH, KW, C, filters), bias (filters).
struct Conv2dLayer {
  Index filters = 1, kh = 1, kw = 1, stride_h = 1, stride_w = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;
};

/// depthwise_kernel (KH, KW, C, multiplier), bias (C·multiplier).
struct DepthwiseConv2dLayer {
  Index kh = 1, kw = 1, stride_h = 1, stride_w = 1, multiplier = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;
};

/// depthwise_kernel (KH, KW, C, multiplier), pointwise_kernel (1, 1, C·multiplier, filters), bias (filters).
struct SeparableConv2dLayer {
  Index filters = 1, kh = 1, kw = 1, stride_h = 1, stride_w = 1, multiplier = 1;
  Padding padding{};
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;
};

/// kernel (C, units), bias (units).
struct DenseLayer {
  Index units = 1;
  bool bias = true;
  Activation activation = Activation::none;
  Initializer initializer = Initializer::glorot_uniform;
};

/// gamma, beta, moving_mean, moving_variance (C).
struct BatchNormLayer {
  ops::BatchNormOptions options{};
};

struct ActivationLayer {
  Activation activation = Activation::relu;
};

enum class PoolKind { max, average };

struct Pool2dLayer {
  PoolKind kind = PoolKind::max;
  WindowOptions window{};
};

/// (H, W, C) -> (C), or (1, 1, C) where the dimensions are kept.
struct GlobalPool2dLayer {
  PoolKind kind = PoolKind::average;
  bool keep_dimensions = false;
};

struct ZeroPadding2dLayer {
  Padding padding{};
};

struct AddLayer {};
struct ConcatLayer {};
struct FlattenLayer {};

struct ReshapeLayer {
  Shape shape{};
};

struct DropoutLayer {
  double rate = 0.5;
};

using Layer = std::variant<InputLayer, Conv2dLayer, DepthwiseConv2dLayer, SeparableConv2dLayer, DenseLayer,
                           BatchNormLayer, ActivationLayer, Pool2dLayer, GlobalPool2dLayer, ZeroPadding2dLayer,
                           AddLayer, ConcatLayer, FlattenLayer, ReshapeLayer, DropoutLayer>;

/// Keras' class name of the layer: "Conv2D", "BatchNormalization", ….
const char* kind(const Layer&);

/// One array that a layer owns, in Keras' order of a layer's weights. The arrays that training does not follow by
/// gradient (moving statistics) come last.
struct ParameterSpec {
  std::string name;
  Shape shape{};
  Initializer initializer;
  bool trainable = true;
};

/// The layer's parameters on an input of the given shape.
std::vector<ParameterSpec> parameters(const Layer&, const std::vector<Shape>& inputs);

/// The layer's output shape on inputs of the given shapes. Throws Error where they do not fit.
Shape output_shape(const Layer&, const std::vector<Shape>& inputs);

/// For std::visit.
template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace svnet
