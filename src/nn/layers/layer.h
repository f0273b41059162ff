#pragma once
#include <concepts>
#include <string>
#include <variant>
#include <vector>

#include "nn/layers/activation.h"
#include "nn/layers/add.h"
#include "nn/layers/batch_norm.h"
#include "nn/layers/concat.h"
#include "nn/layers/conv2d.h"
#include "nn/layers/dense.h"
#include "nn/layers/depthwise_conv2d.h"
#include "nn/layers/dropout.h"
#include "nn/layers/flatten.h"
#include "nn/layers/global_pool2d.h"
#include "nn/layers/input.h"
#include "nn/layers/multiply.h"
#include "nn/layers/pool2d.h"
#include "nn/layers/reshape.h"
#include "nn/layers/separable_conv2d.h"
#include "nn/layers/zero_padding2d.h"

namespace svnet {

/// What the struct of every layer has, beside its attributes. Shapes leave out the batch.
///   keras_name()          Keras' class name: "Conv2D"
///   parameters(inputs)    what it owns if it reads inputs of these shapes, for which output_shape does not throw
///   output_shape(inputs)  throws Error if inputs or attributes do not fit
///   visit(layer, field)   calls field("name", layer.member) for each attribute that files hold, under these names
/// Optional:
///   kFoldingKernel        the parameter (…, K) whose last axis is the output channels, of a layer with `bias` and
///                         `activation`: the runtime folds a batch norm that follows into it (depthwise: (KH, KW, C,
///                         M))
///   keras_classes()       a layer of each class, if one struct stands for several
template <class L>
concept DescribedLayer = requires(const L& layer, L& changed, const Shapes& inputs) {
  { layer.keras_name() } -> std::same_as<const char*>;
  { layer.parameters(inputs) } -> std::same_as<std::vector<ParameterSpec>>;
  { layer.output_shape(inputs) } -> std::same_as<Shape>;
  L::visit(layer, [](const char*, const auto&) {});
  L::visit(changed, [](const char*, auto&) {});
};

template <DescribedLayer... L>
using LayerVariant = std::variant<L...>;

/// What a node of a Graph does.
using Layer = LayerVariant<InputLayer, Conv2dLayer, DepthwiseConv2dLayer, SeparableConv2dLayer, DenseLayer,
                           BatchNormLayer, ActivationLayer, Pool2dLayer, GlobalPool2dLayer, ZeroPadding2dLayer,
                           AddLayer, MultiplyLayer, ConcatLayer, FlattenLayer, ReshapeLayer, DropoutLayer>;

/// Keras' class name of the layer: "Conv2D", "BatchNormalization", ….
const char* keras_name(const Layer&);

/// A layer of that class with default attributes. Throws Error with the nearest name if there is none.
Layer layer_of_class(const std::string& keras_name);

/// The layer's parameters on inputs of the given shapes.
std::vector<ParameterSpec> parameters(const Layer&, const Shapes& inputs);

/// The layer's output shape on inputs of the given shapes. Throws Error if they do not fit, or if the output is empty
/// or has more than 2^40 elements.
Shape output_shape(const Layer&, const Shapes& inputs);

/// For std::visit.
template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

}  // namespace svnet
