#include "io/onnx/layer_nodes.h"

#include <algorithm>
#include <array>

#include "io/onnx/layer_weights.h"

namespace svnet::io {
namespace {

using Integers = std::vector<std::int64_t>;

bool has_zeros(const OnnxValue& value) { return value.zeros.kind == Padding::Kind::explicit_; }

/// ONNX' pads of a window: top, left, bottom, right. The image of `window` has `zeros` around it already.
Integers pads_of(const Window& window, const Padding& zeros) {
  const auto after = [](Index outputs, Index stride, Index size, Index input, Index before) {
    return std::max<Index>(0, (outputs - 1) * stride + size - input - before);
  };
  const Index bottom = after(window.oh, window.stride_h, window.kh, window.h, window.top);
  const Index right = after(window.ow, window.stride_w, window.kw, window.w, window.left);
  return {window.top + zeros.top, window.left + zeros.left, bottom + zeros.bottom, right + zeros.right};
}

}  // namespace

/// One graph on its way.
class OnnxLayers::Emission {
 public:
  Emission(OnnxLayers& layers, const Graph& graph, const Parameters& parameters, const std::vector<OnnxValue>& inputs)
      : layers_(layers), to_(layers.to_), graph_(graph), parameters_(parameters), inputs_(inputs) {}

  OnnxValue output() {
    for (const GraphNode& node : graph_.nodes()) {
      node_ = &node;
      name_ = layers_.prefix_ + node.name;
      values_.push_back(std::visit([&](const auto& layer) { return value_of(layer); }, node.layer));
      values_.back().shape = node.shape;
    }
    return without_zeros(values_.back());
  }

 private:
  const OnnxValue& input(std::size_t i = 0) const { return values_[static_cast<std::size_t>(node_->inputs[i])]; }
  const Tensor& parameter(const char* name) const { return parameters_.at(node_->name + "/" + name); }
  std::string constant(const char* name) {
    const Tensor& value = parameter(name);
    return to_.add_constant(name_ + "/" + name, value.shape(), value.values<float>());
  }
  std::string kernel(const char* parameter_name, const OnnxKernel& kernel) {
    const bool rounded = is_rounded(std::string("/") + parameter_name, parameter(parameter_name).shape());
    return add_kernel(to_, kernel, layers_.precision_, rounded);
  }
  /// A value as (N, C, H, W), without zeros that are still to be added.
  OnnxValue image(OnnxValue value) {
    if (value.channels_first.empty()) {
      const std::string rows = layers_.rows_of(value);
      const Index h = value.shape.size() == 3 ? value.shape[0] : 1, w = value.shape.size() == 3 ? value.shape[1] : 1;
      value.channels_first = {h, w, element_count(value.shape) / (h * w)};
      const Index channels = value.channels_first[2];
      if (h * w == 1) {
        value.name = to_.add("Reshape", unused_name("image"), {rows, new_constant("as_image", {0, channels, 1, 1})});
      } else {
        const std::string shaped =
            to_.add("Reshape", unused_name("shaped"), {rows, new_constant("shape", {0, h, w, channels})});
        value.name = to_.add("Transpose", unused_name("image"), {shaped}, {{"perm", Integers{0, 3, 1, 2}}});
      }
    }
    if (has_zeros(value)) {
      const Padding& z = value.zeros;
      const std::string pads = new_constant("pads", {0, 0, z.top, z.left, 0, 0, z.bottom, z.right});
      value.name = to_.add("Pad", unused_name("padded"), {value.name, pads});
      value.channels_first[0] += z.top + z.bottom;
      value.channels_first[1] += z.left + z.right;
      value.zeros = {};
    }
    return value;
  }
  OnnxValue without_zeros(const OnnxValue& value) { return has_zeros(value) ? image(value) : value; }
  std::string unused_name(const char* what) { return joined(name_, ":", what, number_++); }
  std::string new_constant(const char* what, const Integers& values) {
    return to_.add_constant(unused_name(what), {static_cast<Index>(values.size())}, values);
  }

  OnnxValue activated(OnnxValue value, Activation activation) {
    const auto name = [&](const char* what) { return name_ + ":" + what; };
    const auto add = [&](const char* op, std::vector<std::string> from,
                         std::vector<std::pair<std::string, OnnxAttribute>> attributes = {}) {
      return to_.add(op, name(op), std::move(from), std::move(attributes));
    };
    const auto hard_sigmoid = [&] { return add("HardSigmoid", {value.name}, {{"alpha", 1.0f / 6}, {"beta", 0.5f}}); };
    switch (activation) {
      case Activation::none:
        break;
      case Activation::relu:
        value.name = add("Relu", {value.name});
        break;
      case Activation::relu6: {
        const std::array<float, 1> low{0}, high{6};
        const std::string least = to_.add_constant(name("low"), {}, low),
                          most = to_.add_constant(name("high"), {}, high);
        value.name = add("Clip", {value.name, least, most});
        break;
      }
      case Activation::sigmoid:
        value.name = add("Sigmoid", {value.name});
        break;
      case Activation::hard_sigmoid:
        value.name = hard_sigmoid();
        break;
      case Activation::hard_swish:
        value.name = add("Mul", {value.name, hard_sigmoid()});
        break;
      case Activation::softmax:
        value = {.name = layers_.rows_of(value), .shape = value.shape};
        value.name = add("Softmax", {value.name}, {{"axis", std::int64_t{-1}}});
        break;
    }
    return value;
  }

  OnnxValue value_of(const InputLayer&) { return inputs_.at(next_input_++); }

  /// A convolution of the input, or of `from`.
  OnnxValue convolution(const OnnxValue& from, const std::string& name, const WindowOptions& options,
                        const std::string& weights, bool has_bias, Index group) {
    OnnxValue value = from.channels_first.empty() ? image(from) : from;
    const Shape& size = value.channels_first;
    const Padding zeros = value.zeros;
    const Window window = window_over("onnx", 1, size[0] + zeros.top + zeros.bottom, size[1] + zeros.left + zeros.right,
                                      size[2], options);
    std::vector<std::string> inputs{value.name, weights};
    if (has_bias) inputs.push_back(constant("bias"));
    const std::string result = to_.add("Conv", name, std::move(inputs),
                                       {{"kernel_shape", Integers{window.kh, window.kw}},
                                        {"strides", Integers{window.stride_h, window.stride_w}},
                                        {"pads", pads_of(window, zeros)},
                                        {"group", std::int64_t{group}}});
    return {.name = result, .channels_first = {window.oh, window.ow, 0}};
  }
  OnnxValue with_channels(OnnxValue value, Index channels) {
    value.channels_first[2] = channels;
    return value;
  }

  OnnxValue value_of(const Conv2dLayer& l) {
    const std::string weights = kernel("kernel", convolution_kernel(name_ + "/kernel", parameter("kernel")));
    return activated(with_channels(convolution(input(), name_, window_of(l), weights, l.bias, 1), l.filters),
                     l.activation);
  }
  OnnxValue value_of(const DepthwiseConv2dLayer& l) {
    const Tensor& taps = parameter("depthwise_kernel");
    const std::string weights = kernel("depthwise_kernel", depthwise_kernel(name_ + "/depthwise_kernel", taps));
    const Index channels = taps.dim(2);
    return activated(
        with_channels(convolution(input(), name_, window_of(l), weights, l.bias, channels), channels * l.multiplier),
        l.activation);
  }
  OnnxValue value_of(const SeparableConv2dLayer& l) {
    const Tensor &taps = parameter("depthwise_kernel"), &mixing = parameter("pointwise_kernel");
    const std::string first = kernel("depthwise_kernel", depthwise_kernel(name_ + "/depthwise_kernel", taps));
    const std::string second = kernel("pointwise_kernel", convolution_kernel(name_ + "/pointwise_kernel", mixing));
    const OnnxValue between =
        with_channels(convolution(input(), name_ + ":depthwise", window_of(l), first, false, taps.dim(2)),
                      taps.dim(2) * l.multiplier);
    return activated(with_channels(convolution(between, name_, {}, second, l.bias, 1), l.filters), l.activation);
  }

  OnnxValue value_of(const DenseLayer& l) {
    const std::vector<OnnxValue> parts = input().parts.empty() ? std::vector{input()} : input().parts;
    std::string sum;
    Index first = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const OnnxValue& part = parts[i];
      const Index count = element_count(part.shape);
      const std::string suffix = parts.size() == 1 ? std::string() : joined(":", i);
      const std::string weights = kernel("kernel", dense_kernel(joined(name_, "/kernel", suffix), parameter("kernel"),
                                                                first, count, part.channels_first));
      const std::string row = part.channels_first.empty() ? layers_.rows_of(part)
                                                          : to_.add("Flatten", unused_name("row"), {image(part).name});
      const std::string product = to_.add("MatMul", joined(name_, ":product", suffix), {row, weights});
      sum = sum.empty() ? product : to_.add("Add", joined(name_, ":sum", suffix), {sum, product});
      first += count;
    }
    if (l.bias) sum = to_.add("Add", name_, {sum, constant("bias")});
    return activated({.name = sum, .shape = node_->shape}, l.activation);
  }

  OnnxValue value_of(const BatchNormLayer& l) {
    OnnxValue value = input();
    if (value.channels_first.empty())
      value = {.name = layers_.rows_of(value), .shape = value.shape};
    else
      value = image(value);
    check(!value.channels_first.empty() || value.shape.size() == 1, "[onnx] ", node_->name, ": a norm of ",
          to_string(value.shape), " cannot be exported");
    value.name =
        to_.add("BatchNormalization", name_,
                {value.name, constant("gamma"), constant("beta"), constant("moving_mean"), constant("moving_variance")},
                {{"epsilon", static_cast<float>(l.options.epsilon)}});
    return value;
  }

  OnnxValue value_of(const ActivationLayer& l) {
    OnnxValue value = input();
    if (!value.parts.empty()) value = {.name = layers_.rows_of(value), .shape = value.shape};
    return activated(without_zeros(value), l.activation);
  }

  OnnxValue value_of(const Pool2dLayer& l) {
    const OnnxValue value = image(input());
    const Shape size = value.channels_first;
    const Window window = window_over("onnx", 1, size[0], size[1], size[2], l.window);
    return {.name = to_.add(l.kind == PoolKind::max ? "MaxPool" : "AveragePool", name_, {value.name},
                            {{"kernel_shape", Integers{window.kh, window.kw}},
                             {"strides", Integers{window.stride_h, window.stride_w}},
                             {"pads", pads_of(window, {})}}),
            .channels_first = {window.oh, window.ow, size[2]}};
  }
  OnnxValue value_of(const GlobalPool2dLayer& l) {
    const OnnxValue value = image(input());
    return {.name = to_.add(l.kind == PoolKind::max ? "GlobalMaxPool" : "GlobalAveragePool", name_, {value.name}),
            .channels_first = {1, 1, value.channels_first[2]}};
  }
  OnnxValue value_of(const ZeroPadding2dLayer& l) {
    OnnxValue value = image(input());
    value.zeros = l.padding;
    return value;
  }

  OnnxValue value_of(const AddLayer&) {
    const bool are_images = node_->shape.size() == 3;
    OnnxValue sum = same_layout(0, are_images);
    for (std::size_t i = 1; i < node_->inputs.size(); ++i)
      sum.name = to_.add("Add", i + 1 == node_->inputs.size() ? name_ : unused_name("sum"),
                         {sum.name, same_layout(i, are_images).name});
    return sum;
  }
  OnnxValue value_of(const MultiplyLayer&) {
    const bool are_images = node_->shape.size() == 3;
    const OnnxValue first = same_layout(0, are_images), second = same_layout(1, are_images);
    const std::string product = to_.add("Mul", name_, {first.name, second.name});
    const bool second_is_image = element_count(input(1).shape) > element_count(input(0).shape);
    OnnxValue value = second_is_image ? second : first;
    value.name = product;
    return value;
  }
  OnnxValue same_layout(std::size_t i, bool as_image) {
    if (as_image) return image(input(i));
    return {.name = layers_.rows_of(input(i)), .shape = input(i).shape};
  }

  OnnxValue value_of(const ConcatLayer&) {
    if (node_->shape.size() != 3) {
      OnnxValue value;
      for (std::size_t i = 0; i < node_->inputs.size(); ++i) {
        const OnnxValue part = input(i);
        if (part.parts.empty())
          value.parts.push_back(part);
        else
          value.parts.insert(value.parts.end(), part.parts.begin(), part.parts.end());
      }
      return value;
    }
    std::vector<std::string> names;
    OnnxValue value;
    for (std::size_t i = 0; i < node_->inputs.size(); ++i) {
      value = image(input(i));
      names.push_back(value.name);
    }
    value.name = to_.add("Concat", name_, names, {{"axis", std::int64_t{1}}});
    value.channels_first = node_->shape;
    return value;
  }

  OnnxValue value_of(const FlattenLayer&) { return without_zeros(input()); }
  OnnxValue value_of(const ReshapeLayer&) {
    if (input().shape == node_->shape) return input();
    return {.name = layers_.rows_of(without_zeros(input()))};
  }
  OnnxValue value_of(const DropoutLayer&) { return input(); }

  OnnxLayers& layers_;
  OnnxGraph& to_;
  const Graph& graph_;
  const Parameters& parameters_;
  const std::vector<OnnxValue>& inputs_;
  std::size_t next_input_ = 0;
  std::vector<OnnxValue> values_;
  const GraphNode* node_ = nullptr;
  std::string name_;
  int number_ = 0;
};

OnnxValue OnnxLayers::add(const Graph& graph, const Parameters& parameters, const std::vector<OnnxValue>& inputs) {
  return Emission(*this, graph, parameters, inputs).output();
}

std::string OnnxLayers::rows_of(const OnnxValue& value) {
  if (!value.parts.empty()) {
    std::vector<std::string> names;
    for (const OnnxValue& part : value.parts) names.push_back(rows_of(part));
    return to_.add("Concat", joined(prefix_, "side_by_side", to_.nodes.size()), names, {{"axis", std::int64_t{-1}}});
  }
  if (value.channels_first.empty()) return value.name;
  std::string name = value.name;
  if (value.channels_first[0] * value.channels_first[1] > 1)
    name = to_.add("Transpose", name + ":channels_last", {name}, {{"perm", Integers{0, 2, 3, 1}}});
  return to_.add("Flatten", joined(name, ":row", to_.nodes.size()), {name}, {{"axis", std::int64_t{1}}});
}

}  // namespace svnet::io
