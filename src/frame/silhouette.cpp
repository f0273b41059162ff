#include "frame/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/cleaned_mask.h"
#include "frame/otsu.h"
#include "frame/reduce.h"
#include "frame/rise.h"
#include "frame/table_plane.h"

namespace svnet::frame {
namespace {

/// In standard deviations of a channel: sqrt(3) times 2.5 of the three together.
constexpr double kLeastNoise = 4.33;

/// How much a colour differs from the table's, with darkening along the table's colour discounted.
double difference_of(const std::int64_t* colour, const std::array<double, 3>& table) {
  constexpr double kShadow = 0.1, kDarkestShadow = 0.5;
  double squares = 0, along = 0, table_squares = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double step = static_cast<double>(colour[c]) - table[c];
    squares += step * step;
    along += step * table[c];
    table_squares += table[c] * table[c];
  }
  if (!(table_squares > 0)) return std::sqrt(squares);  // a black table casts no shadow
  const double length = std::sqrt(table_squares);
  along /= length;
  const double across = std::max(squares - along * along, 0.0), darkening = -along, limit = kDarkestShadow * length;
  if (darkening > 0) along = kShadow * std::min(darkening, limit) + std::max(darkening - limit, 0.0);
  return std::sqrt(across + along * along);
}

}  // namespace

Silhouette silhouette_of(const Image& top_image) {
  constexpr double kLikely = 0.5;  // of the threshold, for cells that touch surer ones
  const std::vector<std::int64_t> colours = reduced_colours(top_image);
  const TablePlane table = fit_table(colours, 3, Grid<std::uint8_t>(static_cast<std::size_t>(kCells), 1));
  Grid<double> difference(static_cast<std::size_t>(kCells));
  for (Index cell = 0; cell < kCells; ++cell) {
    const Index row = cell / kSide, column = cell % kSide;
    if (!in_circle(row, column)) continue;
    const std::array<double, 3> here{table.planes[0].at(row, column), table.planes[1].at(row, column),
                                     table.planes[2].at(row, column)};
    difference[static_cast<std::size_t>(cell)] = difference_of(colours.data() + 3 * cell, here);
  }
  // Noise of less than a quarter of a level is rounding.
  const double least = kLeastNoise * std::max(table.noise, 0.25 * kLevel);
  const double sure = std::max(otsu_threshold(difference), least);
  return {cleaned_mask(difference, std::max(kLikely * sure, least), sure)};
}

Silhouette silhouette_of(const DepthImage& top_depth) {
  constexpr double kLeast_m = 0.0015, kLeastShare = 0.05, kHighest = 0.98;
  Rise rise = rise_of(top_depth);
  double least = std::max(kLeastNoise * rise.noise_m, kLeast_m);
  std::vector<double> above;
  for (double& metres : rise.metres) {
    if (!(metres > 0)) metres = 0;
    if (metres > least) above.push_back(metres);
  }
  if (!above.empty()) {
    const auto place = above.begin() + static_cast<std::ptrdiff_t>(kHighest * static_cast<double>(above.size() - 1));
    std::nth_element(above.begin(), place, above.end());
    least = std::max(least, kLeastShare * *place);
  }
  return {cleaned_mask(rise.metres, least, least)};
}

Silhouette silhouette_of_mask(Index height, Index width, const std::vector<std::uint8_t>& mask) {
  Silhouette silhouette{reduced_mask(height, width, mask)};
  for (Index cell = 0; cell < kCells; ++cell)
    if (!in_circle(cell / kSide, cell % kSide)) silhouette.inside[static_cast<std::size_t>(cell)] = 0;
  return silhouette;
}

}  // namespace svnet::frame
