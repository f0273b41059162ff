#include "nn/graph/layer.h"

#include <algorithm>

namespace svnet {
namespace {

WindowOptions window_of(const auto& layer) {
  return {
      .kh = layer.kh, .kw = layer.kw, .stride_h = layer.stride_h, .stride_w = layer.stride_w, .padding = layer.padding};
}

/// The shape of images that a window slides over, with `channels` in the end.
Shape slid(const char* kind, const Shape& input, const WindowOptions& options, Index channels) {
  check(input.size() == 3, "[", kind, "] expects images HxWxC, got ", to_string(input));
  const Window w = window_over(kind, 1, input[0], input[1], input[2], options);
  return {w.oh, w.ow, channels};
}

void add_bias(std::vector<ParameterSpec>& specs, bool bias, Index size) {
  if (bias) specs.push_back({"bias", {size}, Initializer::zeros});
}

}  // namespace

const char* kind(const Layer& layer) {
  return std::visit(
      Overloaded{[](const InputLayer&) { return "InputLayer"; }, [](const Conv2dLayer&) { return "Conv2D"; },
                 [](const DepthwiseConv2dLayer&) { return "DepthwiseConv2D"; },
                 [](const SeparableConv2dLayer&) { return "SeparableConv2D"; },
                 [](const DenseLayer&) { return "Dense"; }, [](const BatchNormLayer&) { return "BatchNormalization"; },
                 [](const ActivationLayer&) { return "Activation"; },
                 [](const Pool2dLayer& l) { return l.kind == PoolKind::max ? "MaxPooling2D" : "AveragePooling2D"; },
                 [](const GlobalPool2dLayer& l) {
                   return l.kind == PoolKind::max ? "GlobalMaxPooling2D" : "GlobalAveragePooling2D";
                 },
                 [](const ZeroPadding2dLayer&) { return "ZeroPadding2D"; }, [](const AddLayer&) { return "Add"; },
                 [](const ConcatLayer&) { return "Concatenate"; }, [](const FlattenLayer&) { return "Flatten"; },
                 [](const ReshapeLayer&) { return "Reshape"; }, [](const DropoutLayer&) { return "Dropout"; }},
      layer);
}

std::vector<ParameterSpec> parameters(const Layer& layer, const std::vector<Shape>& inputs) {
  const Index channels = inputs.empty() || inputs[0].empty() ? 0 : inputs[0].back();
  std::vector<ParameterSpec> specs;
  std::visit(
      Overloaded{[&](const Conv2dLayer& l) {
                   specs.push_back({"kernel", {l.kh, l.kw, channels, l.filters}, l.initializer});
                   add_bias(specs, l.bias, l.filters);
                 },
                 [&](const DepthwiseConv2dLayer& l) {
                   specs.push_back({"depthwise_kernel", {l.kh, l.kw, channels, l.multiplier}, l.initializer});
                   add_bias(specs, l.bias, channels * l.multiplier);
                 },
                 [&](const SeparableConv2dLayer& l) {
                   specs.push_back({"depthwise_kernel", {l.kh, l.kw, channels, l.multiplier}, l.initializer});
                   specs.push_back({"pointwise_kernel", {1, 1, channels * l.multiplier, l.filters}, l.initializer});
                   add_bias(specs, l.bias, l.filters);
                 },
                 [&](const DenseLayer& l) {
                   specs.push_back({"kernel", {channels, l.units}, l.initializer});
                   add_bias(specs, l.bias, l.units);
                 },
                 [&](const BatchNormLayer&) {
                   specs.push_back({"gamma", {channels}, Initializer::ones});
                   specs.push_back({"beta", {channels}, Initializer::zeros});
                   specs.push_back({"moving_mean", {channels}, Initializer::zeros, false});
                   specs.push_back({"moving_variance", {channels}, Initializer::ones, false});
                 },
                 [](const auto&) {}},
      layer);
  return specs;
}

namespace {

Shape unchecked_output_shape(const Layer& layer, const std::vector<Shape>& inputs) {
  const auto one = [&]() -> const Shape& {
    check(inputs.size() == 1, "[", kind(layer), "] takes one input, got ", inputs.size());
    return inputs[0];
  };
  return std::visit(
      Overloaded{
          [&](const InputLayer& l) -> Shape { return l.shape; },
          [&](const Conv2dLayer& l) { return slid("Conv2D", one(), window_of(l), l.filters); },
          [&](const DepthwiseConv2dLayer& l) {
            return slid("DepthwiseConv2D", one(), window_of(l), one().empty() ? 0 : one().back() * l.multiplier);
          },
          [&](const SeparableConv2dLayer& l) { return slid("SeparableConv2D", one(), window_of(l), l.filters); },
          [&](const DenseLayer& l) -> Shape {
            check(one().size() == 1, "[Dense] expects features, got ", to_string(one()), " (flatten first)");
            return {l.units};
          },
          [&](const Pool2dLayer& l) { return slid(kind(layer), one(), l.window, one().empty() ? 0 : one().back()); },
          [&](const GlobalPool2dLayer& l) -> Shape {
            check(one().size() == 3, "[", kind(layer), "] expects images HxWxC, got ", to_string(one()));
            return l.keep_dimensions ? Shape{1, 1, one().back()} : Shape{one().back()};
          },
          [&](const ZeroPadding2dLayer& l) -> Shape {
            check(one().size() == 3, "[ZeroPadding2D] expects images HxWxC, got ", to_string(one()));
            const auto [least, most] = std::minmax({l.padding.top, l.padding.bottom, l.padding.left, l.padding.right});
            check(l.padding.kind == Padding::Kind::explicit_ && least >= 0,
                  "[ZeroPadding2D] needs four numbers of zeros, none negative");
            check(most < kLargestWindow, "[ZeroPadding2D] ", most, " zeros are too many");
            return {one()[0] + l.padding.top + l.padding.bottom, one()[1] + l.padding.left + l.padding.right, one()[2]};
          },
          [&](const AddLayer&) -> Shape {
            check(inputs.size() >= 2, "[Add] takes two inputs or more, got ", inputs.size());
            for (const Shape& shape : inputs)
              check(shape == inputs[0], "[Add] shapes differ: ", to_string(inputs[0]), " and ", to_string(shape));
            return inputs[0];
          },
          [&](const ConcatLayer&) -> Shape {
            check(inputs.size() >= 2, "[Concatenate] takes two inputs or more, got ", inputs.size());
            Shape shape = inputs[0];
            check(!shape.empty(), "[Concatenate] expects at least one axis");
            shape.back() = 0;
            for (const Shape& part : inputs) {
              check(part.size() == shape.size() && std::equal(shape.begin(), shape.end() - 1, part.begin()),
                    "[Concatenate] shapes differ before the last axis: ", to_string(inputs[0]), " and ",
                    to_string(part));
              shape.back() += part.back();
            }
            return shape;
          },
          [&](const FlattenLayer&) -> Shape { return {element_count(one())}; },
          [&](const ReshapeLayer& l) -> Shape {
            check(element_count(one()) == element_count(l.shape), "[Reshape] cannot reshape ", to_string(one()), " to ",
                  to_string(l.shape));
            return l.shape;
          },
          [&](const DropoutLayer& l) -> Shape {
            check(l.rate >= 0 && l.rate < 1, "[Dropout] rate ", l.rate, " is outside [0, 1)");
            return one();
          },
          [&](const auto&) -> Shape { return one(); }},
      layer);
}

}  // namespace

Shape output_shape(const Layer& layer, const std::vector<Shape>& inputs) {
  Shape shape = unchecked_output_shape(layer, inputs);
  constexpr Index kMostOfAxis = Index{1} << 31, kMost = Index{1} << 40;
  Index count = 1;
  for (Index size : shape) {
    check(size > 0 && size < kMostOfAxis && count <= kMost / size, "[", kind(layer), "] gives ", to_string(shape),
          ", which is empty or too large");
    count *= size;
  }
  return shape;
}

}  // namespace svnet
