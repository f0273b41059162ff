#include "frame/reduce.h"

#include <algorithm>
#include <cmath>

#include "frame/image_check.h"

namespace svnet::frame {
namespace {

/// One pixel of a row or column that overlaps a cell, and the length of the overlap in units of 1/cells pixel.
struct Overlap {
  Index pixel, length;
};

/// Per cell, its pixels along one axis of a square of `side` pixels that begins at pixel `start`. The lengths of a cell
/// add up to `side`.
std::vector<std::vector<Overlap>> overlaps(Index start, Index side, Index cells) {
  std::vector<std::vector<Overlap>> of_cells(static_cast<std::size_t>(cells));
  for (Index cell = 0; cell < cells; ++cell)
    for (Index pixel = cell * side / cells; pixel * cells < (cell + 1) * side; ++pixel) {
      const Index length = std::min((cell + 1) * side, (pixel + 1) * cells) - std::max(cell * side, pixel * cells);
      of_cells[static_cast<std::size_t>(cell)].push_back({start + pixel, length});
    }
  return of_cells;
}

/// Calls body(cell, pixel, area) for every pixel of the centred square and every one of cells x cells cells that it
/// overlaps. The areas of a cell add up to side².
template <class Body>
void for_overlaps(Index height, Index width, Index cells, const Body& body) {
  const Index side = std::min(height, width);
  const auto rows = overlaps((height - side) / 2, side, cells), columns = overlaps((width - side) / 2, side, cells);
  for (Index row = 0; row < cells; ++row)
    for (const Overlap& y : rows[static_cast<std::size_t>(row)])
      for (Index column = 0; column < cells; ++column)
        for (const Overlap& x : columns[static_cast<std::size_t>(column)])
          body(static_cast<std::size_t>(row * cells + column), static_cast<std::size_t>(y.pixel * width + x.pixel),
               y.length * x.length);
}

}  // namespace

std::vector<std::int64_t> reduced_colours(const Image& image) {
  check_image("image", image.height, image.width, image.rgb.size(), 3);
  std::vector<std::int64_t> sums(static_cast<std::size_t>(kCells * 3));
  for_overlaps(image.height, image.width, kSide, [&](std::size_t cell, std::size_t pixel, Index area) {
    for (std::size_t c = 0; c < 3; ++c) sums[cell * 3 + c] += area * image.rgb[pixel * 3 + c];
  });
  const Index side = std::min(image.height, image.width), area = side * side;
  for (std::int64_t& sum : sums) sum = (sum * kLevel + area / 2) / area;
  return sums;
}

Image reduced_image(const Image& image, Index side) {
  check_image("image", image.height, image.width, image.rgb.size(), 3);
  check(side > 0, "[frame] an image cannot be reduced to ", side, " pixels");
  std::vector<std::int64_t> sums(static_cast<std::size_t>(side * side * 3));
  for_overlaps(image.height, image.width, side, [&](std::size_t cell, std::size_t pixel, Index area) {
    for (std::size_t c = 0; c < 3; ++c) sums[cell * 3 + c] += area * image.rgb[pixel * 3 + c];
  });
  const Index shorter = std::min(image.height, image.width), area = shorter * shorter;
  Image reduced{side, side, std::vector<std::uint8_t>(sums.size())};
  std::transform(sums.begin(), sums.end(), reduced.rgb.begin(),
                 [&](std::int64_t sum) { return static_cast<std::uint8_t>((sum + area / 2) / area); });
  return reduced;
}

Grid<std::uint8_t> reduced_mask(Index height, Index width, const std::vector<std::uint8_t>& mask) {
  check_image("mask", height, width, mask.size(), 1);
  Grid<Index> covered(static_cast<std::size_t>(kCells));
  for_overlaps(height, width, kSide, [&](std::size_t cell, std::size_t pixel, Index area) {
    if (mask[pixel] != 0) covered[cell] += area;
  });
  const Index side = std::min(height, width);
  Grid<std::uint8_t> cells(covered.size());
  std::transform(covered.begin(), covered.end(), cells.begin(),
                 [&](Index area) { return static_cast<std::uint8_t>(2 * area >= side * side); });
  return cells;
}

Grid<std::int64_t> reduced_depth_um(const DepthImage& depth) {
  check_image("depth image", depth.height, depth.width, depth.metres.size(), 1);
  Grid<std::int64_t> sums(static_cast<std::size_t>(kCells));
  Grid<Index> measured(sums.size());
  for_overlaps(depth.height, depth.width, kSide, [&](std::size_t cell, std::size_t pixel, Index area) {
    const float metres = depth.metres[pixel];
    if (!(metres > 0 && metres < 100)) return;
    sums[cell] += area * std::llround(static_cast<double>(metres) * 1e6);
    measured[cell] += area;
  });
  const Index side = std::min(depth.height, depth.width);
  for (std::size_t cell = 0; cell < sums.size(); ++cell)
    sums[cell] = 2 * measured[cell] >= side * side ? (sums[cell] + measured[cell] / 2) / measured[cell] : 0;
  return sums;
}

}  // namespace svnet::frame
