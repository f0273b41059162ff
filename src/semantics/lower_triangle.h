#pragma once
#include "base/index.h"

namespace svnet {

/// The squared distances between the points of one problem, each pair once: row i holds those to the points before it,
/// padded to whole 64-byte lines, so that a row is written and read without touching its neighbours.
struct LowerTriangle {
  const float* values;  ///< 64-byte aligned; paddings hold anything
  Index points;

  const float* row(Index i) const { return values + row_offset(i); }

  static constexpr Index kLine = 16;  ///< floats

  /// Where row i begins: rows 0, 1 to 16, 17 to 32, … take 0, 1, 2, … lines.
  static constexpr Index row_offset(Index i) {
    const Index before = i == 0 ? 0 : i - 1, group = before / kLine;
    return kLine * (kLine * group * (group + 1) / 2 + before % kLine * (group + 1));
  }
  /// The floats of a triangle of `points` points.
  static constexpr Index size(Index points) { return row_offset(points); }
};

}  // namespace svnet
