#pragma once
#include <cstdint>

#include "frame/grid.h"
#include "image/depth_image.h"
#include "image/image.h"

// Images as kSide x kSide cells. The cells cover the centred square of the image, whose side is the image's
// shorter one (if the other side is longer by an odd number of pixels, the extra pixel is cut off at the right or lower
// end). What lies beyond the square is not looked at. A pixel counts by the area that it has in a cell, and sums are of
// integers: an image turned by quarter turns or mirrored gives the same cells, turned or mirrored.
namespace svnet::frame {

/// The units of a level of a reduced image: 0 to 255 * 256.
inline constexpr std::int64_t kLevel = 256;

/// The mean colour per cell: (kCells, 3), in 1/kLevel of an 8-bit level. Throws Error unless the image has pixels and
/// height x width x 3 values.
std::vector<std::int64_t> reduced_colours(const Image&);

/// The centred square as side x side pixels: the mean colour over the area of each. Throws Error as reduced_colours
/// does, and unless `side` is positive.
Image reduced_image(const Image&, Index side);

/// The share of each cell that `mask` (height, width; 0: background) covers is at least one half. Throws Error unless
/// both sides are positive and the mask has height x width values.
Grid<std::uint8_t> reduced_mask(Index height, Index width, const std::vector<std::uint8_t>& mask);

/// The mean depth of the measured pixels of each cell in micrometres; 0 if less than half of the cell was measured.
/// Not measured: depth that is not a number in (0, 100) m. Throws Error unless the image has pixels and
/// height x width values.
Grid<std::int64_t> reduced_depth_um(const DepthImage&);

}  // namespace svnet::frame
