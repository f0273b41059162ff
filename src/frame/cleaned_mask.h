#pragma once
#include <cstdint>

#include "frame/grid.h"

namespace svnet::frame {

/// A mask (1: object, 0: table) of the inscribed circle from a measure of how much each cell differs from the table:
///  - patches of cells above `likely` with at least 3 cells above `sure` in them (Canny's hysteresis), likely <= sure;
///  - without specks: patches below 8 cells, or below a twentieth of the largest one;
///  - with small holes filled: below a tenth of the mask. Larger ones are part of the object's shape (a roll of tape).
Grid<std::uint8_t> cleaned_mask(const Grid<double>& difference, double likely, double sure);

}  // namespace svnet::frame
