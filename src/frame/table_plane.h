#pragma once
#include <vector>

#include "frame/grid.h"

// The table as it is seen along the border of a top view.
namespace svnet::frame {

/// value = level + x · along_x + y · along_y, with x to the right and y downwards in half cells from the middle.
struct Plane {
  double level = 0, along_x = 0, along_y = 0;

  double at(Index row, Index column) const {
    return level + (along_x * static_cast<double>(half_cells(column)) + along_y * static_cast<double>(half_cells(row)));
  }
};

/// The table's planes, one per channel.
struct TablePlane {
  std::vector<Plane> planes;
  /// The standard deviation of a channel about its plane: noise and texture of the table.
  double noise = 0;
};

/// Fits a plane per channel to the measured cells of the ring (every other one) by iteratively reweighted least squares
/// (Tukey's biweight of the distance over all channels), which begins at the 60 % of the cells that lie nearest to each
/// other's plane: up to 40 % of the ring may show something else. `values` is (kCells, channels), integers below 2^30
/// in size; cells with measured == 0 do not count. All sums are of integers, so the planes of a turned or mirrored grid
/// are the turned or mirrored planes, bit for bit. Throws Error if less than a tenth of the ring was measured.
TablePlane fit_table(const std::vector<std::int64_t>& values, Index channels, const Grid<std::uint8_t>& measured);

}  // namespace svnet::frame
