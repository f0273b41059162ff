#pragma once
#include <vector>

#include "base/index.h"

namespace svnet::frame {

/// The side of every silhouette in cells. Images are reduced to kSide x kSide cells before anything is measured.
inline constexpr Index kSide = 112;
inline constexpr Index kCells = kSide * kSide;

/// The middle of column or row `i` in half cells from the middle of the square: odd, in [-111, 111]. A quarter turn
/// maps these coordinates exactly onto each other.
constexpr Index half_cells(Index i) { return 2 * i - (kSide - 1); }

/// The squared distance of a cell from the middle, in half cells.
constexpr Index squared_radius(Index row, Index column) {
  return half_cells(row) * half_cells(row) + half_cells(column) * half_cells(column);
}

/// The squared radius in half cells of a circle whose radius is `share` of the inscribed circle's.
constexpr double squared_share(double share) { return share * share * static_cast<double>(kSide * kSide); }

/// Whether the middle of the cell lies in the inscribed circle: all that is measured lies there.
constexpr bool in_circle(Index row, Index column) { return squared_radius(row, column) <= kSide * kSide; }

/// Whether the cell lies in the ring along the inscribed circle, .88 to 1 of its radius, where the table is seen.
constexpr bool in_ring(Index row, Index column) {
  return in_circle(row, column) && static_cast<double>(squared_radius(row, column)) >= squared_share(0.88);
}

/// A value per cell, (kSide, kSide), rows from the top.
template <class Value>
using Grid = std::vector<Value>;

}  // namespace svnet::frame
