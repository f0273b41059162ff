#pragma once
#include <cstdint>
#include <vector>

#include "frame/grid.h"
#include "image/depth_image.h"
#include "image/image.h"

// The cells of a top view that show the object. Only the centred square of an image is looked at, and in it the
// inscribed circle (reduce.h, grid.h). A image that is turned by quarter turns or mirrored has the turned or mirrored
// silhouette, cell by cell. All functions are thread-safe and use one thread.
namespace svnet::frame {

struct Silhouette {
  Grid<std::uint8_t> inside;  // (kSide, kSide), rows from the top: 1 on the object, else 0; 0 outside the circle
};

/// From the colours alone. The table is a plane per channel, fitted to the ring along the circle (table_plane.h), so
/// that a gradient of the light does no harm. With p the colour, t the table's colour there, and p - t split into a
/// part a along t and the rest r across it, the difference of a cell is √(|r|² + g²): g = a if the cell is brighter
/// than the table, and if it is darker, g = .1 |a|, plus what |a| exceeds .5 |t| by. So a shadow, which only darkens
/// the table's own colour, counts little. Otsu's threshold and cleaned_mask.h tell the object from the table;
/// differences below 4.3 sd of the table's noise never count. The result is empty if nothing differs. Throws Error for
/// an empty image, and for one without height x width x 3 values.
Silhouette silhouette_of(const Image& top_image);

/// From depth: what stands above the table (rise.h) by 4.3 sd of the noise, by 1.5 mm and by a twentieth of the 98th
/// percentile of what does. Throws Error as rise_of.
Silhouette silhouette_of(const DepthImage& top_depth);

/// From a mask (height, width) of any values, 0 for the table, as a localiser makes it. Cells that it covers at least
/// by half are the object's. Throws Error for an empty mask, and for one without height x width values.
Silhouette silhouette_of_mask(Index height, Index width, const std::vector<std::uint8_t>& mask);

}  // namespace svnet::frame
