#pragma once
#include <cstdint>
#include <vector>

#include "frame/grid.h"

namespace svnet::frame {

/// A connected patch of cells.
struct Patch {
  Index area = 0;              // in cells
  bool touches_rim = false;    // a cell of it has a neighbour outside the inscribed circle
  std::vector<Index> cells{};  // indices of its cells
};

enum class Neighbours { four, eight };

/// The connected patches of cells of the inscribed circle that have `value`, the largest first. Patches of one size are
/// in the order of their first cells.
std::vector<Patch> patches_of(const Grid<std::uint8_t>& grid, std::uint8_t value, Neighbours);

}  // namespace svnet::frame
