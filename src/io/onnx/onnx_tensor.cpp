#include "io/onnx/onnx_tensor.h"

#include <functional>
#include <numeric>
#include <utility>

namespace svnet::io {

Index count_of(const std::vector<Index>& shape) {
  return std::accumulate(shape.begin(), shape.end(), Index{1}, std::multiplies<>());
}

OnnxTensor tensor_of(std::vector<Index> shape, float value) {
  const auto count = static_cast<std::size_t>(count_of(shape));
  return {std::move(shape), std::vector<float>(count, value)};
}

std::vector<Index> strides_of(const std::vector<Index>& shape) {
  std::vector<Index> strides(shape.size(), 1);
  for (std::size_t i = shape.size(); i-- > 1;) strides[i - 1] = strides[i] * shape[i];
  return strides;
}

}  // namespace svnet::io
