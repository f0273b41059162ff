#pragma once
#include <cstddef>
#include <vector>

#include "base/index.h"

namespace svnet::io {

/// A tensor of float32, row-major.
struct OnnxTensor {
  std::vector<Index> shape{};
  std::vector<float> values{};
};

/// The number of elements of a shape.
Index count_of(const std::vector<Index>& shape);

/// A tensor whose elements all are `value`.
OnnxTensor tensor_of(std::vector<Index> shape, float value = 0);

/// Distances between neighbours along each axis.
std::vector<Index> strides_of(const std::vector<Index>& shape);

/// Calls body(i, offset + Σ index_k · stride_k) for all indices of `shape`, in order; i counts them.
template <class Body>
void for_strided(const std::vector<Index>& shape, const std::vector<Index>& strides, Index offset, const Body& body) {
  std::vector<Index> index(shape.size(), 0);
  const Index count = count_of(shape);
  for (Index i = 0; i < count; ++i) {
    body(static_cast<std::size_t>(i), static_cast<std::size_t>(offset));
    for (std::size_t axis = shape.size(); axis-- > 0;) {
      offset += strides[axis];
      if (++index[axis] < shape[axis]) break;
      offset -= strides[axis] * shape[axis];
      index[axis] = 0;
    }
  }
}

}  // namespace svnet::io
