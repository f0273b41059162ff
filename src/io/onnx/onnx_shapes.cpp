#include "io/onnx/onnx_shapes.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace svnet::io {

OnnxTensor onnx_transpose(const OnnxOperands& node) {
  const OnnxTensor& x = node.x();
  const auto perm = node.integers("perm", {});
  const std::vector<Index> strides = strides_of(x.shape);
  if (perm.size() != strides.size()) node.refuse("perm does not fit");
  std::vector<Index> shape, from;
  for (const std::int64_t axis : perm) {
    shape.push_back(x.shape.at(static_cast<std::size_t>(axis)));
    from.push_back(strides.at(static_cast<std::size_t>(axis)));
  }
  OnnxTensor y = tensor_of(shape);
  for_strided(shape, from, 0, [&](std::size_t i, std::size_t place) { y.values[i] = x.values[place]; });
  return y;
}

OnnxTensor onnx_flatten(const OnnxOperands& node) {
  const OnnxTensor& x = node.x();
  return {{x.shape.at(0), count_of(x.shape) / x.shape.at(0)}, x.values};
}

OnnxTensor onnx_reshape(const OnnxOperands& node) {
  const auto wanted = node.integers(1);
  const OnnxTensor& x = node.x();
  std::vector<Index> shape;
  for (std::size_t i = 0; i < wanted.size(); ++i) shape.push_back(wanted[i] == 0 ? x.shape.at(i) : wanted[i]);
  const Index given = -count_of(shape);  // if one size is -1
  if (given > 0) std::ranges::replace(shape, Index{-1}, count_of(x.shape) / given);
  if (count_of(shape) != count_of(x.shape)) node.refuse("the number of elements differs");
  return {shape, x.values};
}

OnnxTensor onnx_concat(const OnnxOperands& node) {
  std::vector<Index> shape = node.x().shape;
  const std::int64_t given = node.integer("axis", 0);
  const auto axis = static_cast<std::size_t>(given < 0 ? given + static_cast<std::int64_t>(shape.size()) : given);
  shape.at(axis) = 0;
  for (std::size_t i = 0; i < node.count(); ++i) shape[axis] += node.x(i).shape.at(axis);
  OnnxTensor y = tensor_of(shape);
  const Index outer =
      std::accumulate(shape.begin(), shape.begin() + static_cast<Index>(axis), Index{1}, std::multiplies<>());
  auto to = y.values.begin();
  for (Index o = 0; o < outer; ++o)
    for (std::size_t i = 0; i < node.count(); ++i) {
      const OnnxTensor& part = node.x(i);
      const Index run = count_of(part.shape) / outer;
      to = std::copy_n(part.values.begin() + o * run, run, to);
    }
  return y;
}

OnnxTensor onnx_pad(const OnnxOperands& node) {
  const auto pads = node.integers(1);
  const OnnxTensor& x = node.x();
  const std::size_t rank = x.shape.size();
  if (pads.size() != 2 * rank) node.refuse("pads do not fit");
  std::vector<Index> shape = x.shape;
  for (std::size_t i = 0; i < rank; ++i) shape[i] += pads[i] + pads[i + rank];
  OnnxTensor y = tensor_of(shape);
  const std::vector<Index> strides = strides_of(shape);
  Index first = 0;
  for (std::size_t i = 0; i < rank; ++i) first += pads[i] * strides[i];
  for_strided(x.shape, strides, first, [&](std::size_t i, std::size_t place) { y.values[place] = x.values[i]; });
  return y;
}

OnnxTensor onnx_reversed_slice(const OnnxOperands& node) {
  const auto axis = static_cast<std::size_t>(node.integers(3).at(0));
  if (node.integers(1).at(0) != -1 || node.integers(4).at(0) != -1) node.refuse("only whole axes can be reversed");
  const OnnxTensor& x = node.x();
  std::vector<Index> strides = strides_of(x.shape);
  const Index last = (x.shape.at(axis) - 1) * strides[axis];
  strides[axis] = -strides[axis];
  OnnxTensor y = tensor_of(x.shape);
  for_strided(y.shape, strides, last, [&](std::size_t i, std::size_t place) { y.values[i] = x.values[place]; });
  return y;
}

}  // namespace svnet::io
