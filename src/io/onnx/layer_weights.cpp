#include "io/onnx/layer_weights.h"

#include "base/bf16.h"

namespace svnet::io {
namespace {

kernels::ChannelShape channels_of(const OnnxKernel& kernel) {
  kernels::ChannelShape shape{.outer = 1, .channels = kernel.shape[static_cast<std::size_t>(kernel.channel_axis)]};
  for (std::size_t axis = 0; axis < kernel.shape.size(); ++axis)
    if (static_cast<Index>(axis) < kernel.channel_axis)
      shape.outer *= kernel.shape[axis];
    else if (static_cast<Index>(axis) > kernel.channel_axis)
      shape.inner *= kernel.shape[axis];
  return shape;
}

/// w (KH·KW, C, K) as (K, C, KH·KW), or with `depthwise` as (C·K, KH·KW).
OnnxKernel channels_last_to_first(std::string name, const Tensor& w, bool depthwise) {
  const Index kh = w.dim(0), kw = w.dim(1), c = w.dim(2), k = w.dim(3), taps = kh * kw;
  std::vector<float> values(static_cast<std::size_t>(w.size()));
  const float* from = w.data<float>();
  for (Index tap = 0; tap < taps; ++tap)
    for (Index in = 0; in < c; ++in)
      for (Index out = 0; out < k; ++out) {
        const Index row = depthwise ? in * k + out : out * c + in;
        values[static_cast<std::size_t>(row * taps + tap)] = from[(tap * c + in) * k + out];
      }
  std::vector<Index> shape = depthwise ? std::vector<Index>{c * k, 1, kh, kw} : std::vector<Index>{k, c, kh, kw};
  return {std::move(name), std::move(shape), std::move(values), 0};
}

}  // namespace

OnnxKernel convolution_kernel(std::string name, const Tensor& kernel) {
  return channels_last_to_first(std::move(name), kernel, false);
}

OnnxKernel depthwise_kernel(std::string name, const Tensor& kernel) {
  return channels_last_to_first(std::move(name), kernel, true);
}

OnnxKernel dense_kernel(std::string name, const Tensor& kernel, Index first, Index count, const Shape& channels_first) {
  const Index units = kernel.dim(1);
  const float* from = kernel.data<float>() + first * units;
  std::vector<float> values(static_cast<std::size_t>(count * units));
  const Index channels = channels_first.empty() ? 1 : channels_first.back(), pixels = count / channels;
  for (Index pixel = 0; pixel < pixels; ++pixel)
    for (Index channel = 0; channel < channels; ++channel)
      std::copy_n(from + (pixel * channels + channel) * units, units,
                  values.begin() + (channel * pixels + pixel) * units);
  return {std::move(name), {count, units}, std::move(values), 1};
}

std::string add_kernel(OnnxGraph& to, OnnxKernel kernel, StoredPrecision precision, bool rounded) {
  if (precision == StoredPrecision::f32 || !rounded)
    return to.add_constant(std::move(kernel.name), std::move(kernel.shape), kernel.values);
  const std::string stored = kernel.name + ":" + name_of(precision);
  if (precision == StoredPrecision::bf16) {
    to.constants.push_back({stored, OnnxType::bf16, std::move(kernel.shape), bf16_bytes(kernel.values)});
    return to.add("Cast", std::move(kernel.name), {stored}, {{"to", std::int64_t{static_cast<int>(OnnxType::f32)}}});
  }
  const kernels::Int8Weights weights = kernels::int8_weights(channels_of(kernel), kernel.values.data());
  const auto bytes = std::as_bytes(std::span(weights.values));
  to.constants.push_back({stored, OnnxType::i8, std::move(kernel.shape), {bytes.begin(), bytes.end()}});
  const std::string scale =
      to.add_constant(kernel.name + ":scale", {static_cast<Index>(weights.scales.size())}, weights.scales);
  return to.add("DequantizeLinear", std::move(kernel.name), {stored, scale},
                {{"axis", std::int64_t{kernel.channel_axis}}});
}

}  // namespace svnet::io
