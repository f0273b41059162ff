#pragma once
#include <span>

#include "base/communicator.h"
#include "base/index.h"
#include "base/parallel.h"
#include "semantics/aligned_array.h"

namespace svnet::semantics {

/// A symmetric (n, n) matrix of squared Euclidean distances in float32 with a zero diagonal. Rows are 64-byte aligned.
class DistanceMatrix {
 public:
  /// All zero. Throws Error if n < 0, NoMemory if it cannot be allocated.
  explicit DistanceMatrix(Index n);

  Index size() const { return size_; }
  const float* row(Index i) const { return values_.data() + i * stride_; }
  float* row(Index i) { return values_.data() + i * stride_; }
  float operator()(Index i, Index j) const { return row(i)[j]; }
  /// All rows with their padding.
  std::span<float> values() { return std::span(values_.data(), size_ * stride_); }

 private:
  Index size_, stride_;
  AlignedArray<float> values_;
};

/// The squared distances between the rows of features (n, dimension), T float or double. Features are centred by their
/// mean, products are accumulated in double, and only the distance is rounded to float32. Rows that nearly coincide are
/// subtracted directly, so that equal rows have distance 0.
///
/// The processes of the communicator share the work. Requires: every process passes the same features. The result has
/// the same bits for any number of threads and processes.
///
/// Throws Error for an empty shape, for a feature that is not finite, for a distance above 1e30, and if rows differ but
/// none is farther than 1e-15 from their mean.
template <class T>
DistanceMatrix squared_distances(const T* features, Index n, Index dimension, Parallel& parallel,
                                 Communicator& communicator = SingleProcess::shared());

}  // namespace svnet::semantics
