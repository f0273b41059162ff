#pragma once
#include <span>

#include "base/communicator.h"
#include "base/index.h"
#include "base/parallel.h"
#include "semantics/aligned_array.h"

namespace svnet {

/// A symmetric n x n matrix of squared Euclidean distances, float32, zero diagonal. Rows start on 64-byte borders.
class DistanceMatrix {
 public:
  /// All zero. Throws Error for n < 0, or where the memory cannot be had.
  explicit DistanceMatrix(Index n);

  Index size() const { return size_; }
  const float* row(Index i) const { return values_.data() + i * stride_; }
  float* row(Index i) { return values_.data() + i * stride_; }
  float operator()(Index i, Index j) const { return row(i)[j]; }
  /// All rows, and what fills them up.
  std::span<float> values() { return std::span(values_.data(), size_ * stride_); }

 private:
  Index size_, stride_;
  AlignedArray<float> values_;
};

/// The squared distances between the rows of features (n, dimension), float or double. Features are centred by their
/// mean, products are accumulated in double, and only the distance is rounded to float32; rows that nearly coincide are
/// subtracted directly, so that equal rows have distance 0. The same bits for any number of threads, and of processes:
/// a communicator, all of which has the features, shares the work. Throws Error for an empty shape, for a feature that
/// is not finite, for a distance beyond 1e30, and where rows differ, but none is farther than 1e-15 from their mean.
template <class T>
DistanceMatrix squared_distances(const T* features, Index n, Index dimension, Parallel& parallel,
                                 Communicator& communicator = SingleProcess::shared());

}  // namespace svnet
