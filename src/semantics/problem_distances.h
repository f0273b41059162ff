#pragma once
#include <cstdint>
#include <span>

#include "semantics/aligned_array.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"

namespace svnet::semantics {

/// The distances between the points of one problem as a square matrix, the working memory of a clustering algorithm.
/// The copy functions fill only the part below the diagonal: elements 0 to i - 1 of row i.
class ProblemDistances {
 public:
  explicit ProblemDistances(Index max_points)
      : max_points_(max_points), values_((max_points + 3) * stride_for(max_points)) {}

  Index max_points() const { return max_points_; }
  Index stride() const { return stride_; }
  float* row(Index i) { return values_.data() + i * stride_; }
  const float* row(Index i) const { return values_.data() + i * stride_; }

  /// Sets the number of points; the distances are undefined afterwards. Requires: points <= max_points().
  void resize(Index points) { stride_ = stride_for(points); }

  /// Copies the distances between some rows of a matrix. Requires: rows.size() <= max_points().
  void copy_rows(const DistanceMatrix& distances, std::span<const std::int32_t> rows) {
    const Index n = rows.size();
    resize(n);
    for (Index i = 1; i < n; ++i) {
      const float* from = distances.row(rows[i]);
      float* to = row(i);
      for (Index j = 0; j < i; ++j) to[j] = from[rows[j]];
    }
  }

  /// Copies a triangle. Requires: triangle.points <= max_points().
  void copy(const LowerTriangle& triangle) {
    resize(triangle.points);
    const float* from = triangle.values;
    for (Index i = 1; i < triangle.points; ++i) {
      float* to = row(i);
      for (Index line = 0; line < i; line += LowerTriangle::kLine, from += LowerTriangle::kLine)
        for (Index j = 0; j < LowerTriangle::kLine; ++j) to[line + j] = from[j];
    }
  }

 private:
  /// A row takes an odd number of cache lines, so that the elements of a column spread over the sets of the cache.
  static Index stride_for(Index points) { return 16 * ((points + 15) / 16 | 1); }

  Index max_points_, stride_ = 0;
  AlignedArray<float> values_;  // three rows more than points: kernels read blocks of four rows
};

}  // namespace svnet::semantics
