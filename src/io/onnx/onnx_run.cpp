#include "io/onnx/onnx_run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <numeric>
#include <string_view>

#include "base/bf16.h"
#include "base/parallel.h"
#include "io/onnx/onnx_operands.h"
#include "io/onnx/onnx_shapes.h"
#include "io/onnx/onnx_windows.h"
#include "nn/kernels/gemm.h"

namespace svnet::io {
namespace {

/// y = f(x) for each element.
template <class F>
OnnxTensor each(const OnnxOperands& node, const F& f) {
  OnnxTensor y = node.x();
  std::ranges::transform(y.values, y.values.begin(), f);
  return y;
}

/// y = f(a, b) for two operands of shapes that are aligned at their last axes; axes of size 1 are repeated.
template <class F>
OnnxTensor broadcast(const OnnxOperands& node, const F& f) {
  const OnnxTensor &a = node.x(0), &b = node.x(1);
  const std::size_t rank = std::max(a.shape.size(), b.shape.size());
  const auto padded_shape = [&](std::vector<Index> shape) {
    shape.insert(shape.begin(), rank - shape.size(), 1);
    return shape;
  };
  const std::vector<Index> sa = padded_shape(a.shape), sb = padded_shape(b.shape);
  std::vector<Index> shape(rank), ta = strides_of(sa), tb = strides_of(sb);
  for (std::size_t i = 0; i < rank; ++i) {
    if (sa[i] != sb[i] && sa[i] != 1 && sb[i] != 1) node.refuse("shapes do not fit");
    shape[i] = sa[i] == 1 ? sb[i] : sa[i];
    if (sa[i] == 1) ta[i] = 0;
    if (sb[i] == 1) tb[i] = 0;
  }
  OnnxTensor y = tensor_of(shape);
  for_strided(shape, ta, 0, [&](std::size_t i, std::size_t from) { y.values[i] = a.values[from]; });
  for_strided(shape, tb, 0, [&](std::size_t i, std::size_t from) { y.values[i] = f(y.values[i], b.values[from]); });
  return y;
}

OnnxTensor clip(const OnnxOperands& node) {
  const float low = node.x(1).values.at(0), high = node.x(2).values.at(0);
  return each(node, [=](float v) { return std::min(std::max(v, low), high); });
}

OnnxTensor hard_sigmoid(const OnnxOperands& node) {
  const float alpha = node.number("alpha"), beta = node.number("beta");
  return each(node, [=](float v) { return std::min(std::max(alpha * v + beta, 0.0f), 1.0f); });
}

/// a (…, M, K) · b (K, N).
OnnxTensor matrix_product(const OnnxOperands& node) {
  const OnnxTensor &a = node.x(0), &b = node.x(1);
  if (a.shape.empty() || b.shape.size() != 2 || a.shape.back() != b.shape[0]) node.refuse("shapes do not fit");
  const Index k = b.shape[0], n = b.shape[1], m = count_of(a.shape) / k;
  std::vector<Index> shape = a.shape;
  shape.back() = n;
  OnnxTensor y = tensor_of(shape);
  kernels::gemm<float>(Parallel::shared(), {.m = m, .n = n, .k = k}, a.values.data(), b.values.data(), y.values.data());
  return y;
}

/// Of channels, the second axis.
OnnxTensor batch_normalization(const OnnxOperands& node) {
  OnnxTensor y = node.x();
  const float *scale = node.x(1).values.data(), *bias = node.x(2).values.data();
  const float *mean = node.x(3).values.data(), *variance = node.x(4).values.data();
  const float epsilon = node.number("epsilon");
  const Index channels = y.shape.at(1), pixels = count_of(y.shape) / y.shape[0] / channels;
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const std::size_t c = i / static_cast<std::size_t>(pixels) % static_cast<std::size_t>(channels);
    y.values[i] = (y.values[i] - mean[c]) / std::sqrt(variance[c] + epsilon) * scale[c] + bias[c];
  }
  return y;
}

/// Over the last axis.
OnnxTensor softmax_of_rows(const OnnxOperands& node) {
  OnnxTensor y = node.x();
  const Index columns = y.shape.back();
  for (auto row = y.values.begin(); row != y.values.end(); row += columns) {
    const float largest = *std::max_element(row, row + columns);
    std::transform(row, row + columns, row, [&](float v) { return std::exp(v - largest); });
    const float sum = std::accumulate(row, row + columns, 0.0f);
    std::transform(row, row + columns, row, [&](float v) { return v / sum; });
  }
  return y;
}

/// Over the first axis, which is dropped.
OnnxTensor mean_of_rows(const OnnxOperands& node) {
  if (node.integers("axes", {}) != std::vector<std::int64_t>{0}) node.refuse("only the first axis can be averaged");
  const OnnxTensor& x = node.x();
  OnnxTensor y = tensor_of(std::vector<Index>(x.shape.begin() + 1, x.shape.end()));
  const Index count = x.shape.at(0), run = count_of(y.shape);
  const float* from = x.values.data();
  for (float& value : y.values) {
    double sum = 0;
    for (Index j = 0; j < count; ++j) sum += static_cast<double>(from[j * run]);
    value = static_cast<float>(sum / static_cast<double>(count));
    ++from;
  }
  return y;
}

OnnxTensor from_bf16(const OnnxOperands& node) {
  const OnnxConstant& from = node.constant(0);
  if (from.type != OnnxType::bf16) node.refuse("the input is not bfloat16");
  OnnxTensor y = tensor_of(from.shape);
  read_bf16(from.bytes, y.values);
  return y;
}

/// With a scale per index of one axis, and no zero point.
OnnxTensor from_int8(const OnnxOperands& node) {
  const OnnxConstant& from = node.constant(0);
  if (from.type != OnnxType::i8) node.refuse("the input is not int8");
  OnnxTensor y = tensor_of(from.shape);
  const std::vector<float>& scales = node.x(1).values;
  const auto axis = static_cast<std::size_t>(node.integer("axis", 1));
  const auto inner = static_cast<std::size_t>(strides_of(from.shape).at(axis));
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const auto value = static_cast<std::int8_t>(from.bytes[i]);
    y.values[i] = static_cast<float>(value) * scales[i / inner % scales.size()];
  }
  return y;
}

struct Operation {
  std::string_view name;
  OnnxTensor (*value)(const OnnxOperands&);
};

constexpr Operation kOperations[]{
    {"Identity", [](const OnnxOperands& node) { return node.x(); }},
    {"Relu", [](const OnnxOperands& node) { return each(node, [](float v) { return v < 0 ? 0 : v; }); }},
    {"Sigmoid", [](const OnnxOperands& node) { return each(node, [](float v) { return 1 / (1 + std::exp(-v)); }); }},
    {"Floor", [](const OnnxOperands& node) { return each(node, [](float v) { return std::floor(v); }); }},
    {"Sin", [](const OnnxOperands& node) { return each(node, [](float v) { return std::sin(v); }); }},
    {"Cos", [](const OnnxOperands& node) { return each(node, [](float v) { return std::cos(v); }); }},
    {"Clip", clip},
    {"HardSigmoid", hard_sigmoid},
    {"Add", [](const OnnxOperands& node) { return broadcast(node, std::plus<>()); }},
    {"Sub", [](const OnnxOperands& node) { return broadcast(node, std::minus<>()); }},
    {"Mul", [](const OnnxOperands& node) { return broadcast(node, std::multiplies<>()); }},
    {"MatMul", matrix_product},
    {"Conv", onnx_convolution},
    {"MaxPool", [](const OnnxOperands& node) { return onnx_pool(node, OnnxPool::max); }},
    {"AveragePool", [](const OnnxOperands& node) { return onnx_pool(node, OnnxPool::average); }},
    {"GlobalMaxPool", [](const OnnxOperands& node) { return onnx_global_pool(node, OnnxPool::max); }},
    {"GlobalAveragePool", [](const OnnxOperands& node) { return onnx_global_pool(node, OnnxPool::average); }},
    {"BatchNormalization", batch_normalization},
    {"Softmax", softmax_of_rows},
    {"Transpose", onnx_transpose},
    {"Flatten", onnx_flatten},
    {"Reshape", onnx_reshape},
    {"Concat", onnx_concat},
    {"Pad", onnx_pad},
    {"Slice", onnx_reversed_slice},
    {"ReduceMean", mean_of_rows},
    {"Cast", from_bf16},
    {"DequantizeLinear", from_int8},
};

OnnxTensor value_of(const std::string& op, const OnnxOperands& node) {
  const auto* found = std::ranges::find(kOperations, op, &Operation::name);
  if (found == std::end(kOperations)) node.refuse("the operation is not known here");
  return found->value(node);
}

OnnxTensor f32_tensor(const OnnxConstant& constant) {
  OnnxTensor tensor{constant.shape, std::vector<float>(constant.bytes.size() / sizeof(float))};
  std::memcpy(tensor.values.data(), constant.bytes.data(), tensor.values.size() * sizeof(float));
  return tensor;
}

}  // namespace

OnnxTensor run_onnx(const OnnxGraph& graph, const std::map<std::string, OnnxTensor>& inputs) {
  std::map<std::string, const OnnxConstant*> constants;
  for (const OnnxConstant& constant : graph.constants) constants[constant.name] = &constant;
  std::map<std::string, OnnxTensor> values = inputs;
  std::map<std::string, std::size_t> last_use;  // values are freed after their last reader
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    for (const std::string& input : graph.nodes[i].inputs) last_use[input] = i;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const OnnxNode& node = graph.nodes[i];
    std::map<std::string, const OnnxTensor*> seen;
    for (const std::string& input : node.inputs) {
      const auto constant = constants.find(input);
      if (constant != constants.end() && constant->second->type == OnnxType::f32 && !values.contains(input))
        values.emplace(input, f32_tensor(*constant->second));
      if (const auto found = values.find(input); found != values.end()) seen[input] = &found->second;
    }
    OnnxTensor value = value_of(node.op, OnnxOperands(node, std::move(seen), constants));
    for (const std::string& input : node.inputs)
      if (last_use.at(input) == i) values.erase(input);
    values[node.name] = std::move(value);
  }
  return values.at(graph.outputs.at(0).name);
}

}  // namespace svnet::io
