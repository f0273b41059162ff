#pragma once
#include "base/index.h"

namespace svnet::semantics {

/// The squared distances between the points of one problem, each pair once. Row i holds the distances to points 0 to
/// i - 1 and is padded to a multiple of 64 bytes, so that rows share no cache line.
struct LowerTriangle {
  const float* values;  ///< 64-byte aligned; the padding is undefined
  Index points;

  const float* row(Index i) const { return values + row_offset(i); }

  static constexpr Index kLine = 16;  ///< floats in a cache line

  /// The offset of row i in floats. Row 0 takes no line, rows 1 to 16 take one, rows 17 to 32 two, and so on.
  static constexpr Index row_offset(Index i) {
    const Index before = i == 0 ? 0 : i - 1, group = before / kLine;
    return kLine * (kLine * group * (group + 1) / 2 + before % kLine * (group + 1));
  }
  /// The number of floats of a triangle of `points` points, with padding.
  static constexpr Index size(Index points) { return row_offset(points); }
};

}  // namespace svnet::semantics
