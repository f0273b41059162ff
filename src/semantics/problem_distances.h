#pragma once
#include <cstdint>
#include <span>

#include "semantics/aligned_array.h"
#include "semantics/distances.h"
#include "semantics/lower_triangle.h"

namespace svnet {

/// The distances between the points of one problem as a square matrix in a thread's own memory, for an algorithm to
/// work in. Only the part below the diagonal is filled here: row i, entries 0 to i - 1.
class ProblemDistances {
 public:
  explicit ProblemDistances(Index max_points)
      : max_points_(max_points), values_((max_points + 3) * stride_for(max_points)) {}

  Index max_points() const { return max_points_; }
  Index stride() const { return stride_; }
  float* row(Index i) { return values_.data() + i * stride_; }
  const float* row(Index i) const { return values_.data() + i * stride_; }

  /// To at most max_points points; the distances are undefined.
  void resize(Index points) { stride_ = stride_for(points); }

  /// At most max_points rows. Below the last row there is memory for three more.
  void gather(const DistanceMatrix& distances, std::span<const std::int32_t> rows) {
    const Index n = rows.size();
    resize(n);
    for (Index i = 1; i < n; ++i) {
      const float* from = distances.row(rows[i]);
      float* to = row(i);
      for (Index j = 0; j < i; ++j) to[j] = from[rows[j]];
    }
  }

  /// At most max_points points.
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
  /// Rows are whole lines, an odd number of them, so that a column's entries spread over the sets of the cache.
  static Index stride_for(Index points) { return 16 * ((points + 15) / 16 | 1); }

  Index max_points_, stride_ = 0;
  AlignedArray<float> values_;
};

}  // namespace svnet
