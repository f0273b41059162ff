#include "frame/object_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "frame/patches.h"

namespace svnet::frame {
namespace {

/// A direction in the image: x to the right, y downwards.
struct Direction {
  double x, y;
};

/// Calls body(x, y) for every cell of the object, in half cells from the middle.
template <class Body>
void for_cells(const Silhouette& silhouette, const Body& body) {
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column)
      if (silhouette.inside[static_cast<std::size_t>(row * kSide + column)] != 0)
        body(half_cells(column), half_cells(row));
}

/// The number of parts of equal size that are as uneven as these: (Σ area)² / Σ area².
double effective_number(const std::vector<Index>& areas) {
  double sum = 0, squares = 0;
  for (const Index area : areas) {
    sum += static_cast<double>(area);
    squares += static_cast<double>(area) * static_cast<double>(area);
  }
  return squares > 0 ? sum * sum / squares : 0;
}

/// The areas of the groups of patches that are at most 2 `reach` cells apart.
std::vector<Index> group_areas(const Silhouette& silhouette, Index reach) {
  Grid<std::uint8_t> wider(silhouette.inside.size());
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column) {
      if (silhouette.inside[static_cast<std::size_t>(row * kSide + column)] == 0) continue;
      for (Index y = std::max<Index>(row - reach, 0); y <= std::min(row + reach, kSide - 1); ++y)
        for (Index x = std::max<Index>(column - reach, 0); x <= std::min(column + reach, kSide - 1); ++x)
          if ((y - row) * (y - row) + (x - column) * (x - column) <= reach * reach)
            wider[static_cast<std::size_t>(y * kSide + x)] = 1;
    }
  std::vector<Index> areas;
  for (const Patch& group : patches_of(wider, 1, Neighbours::eight))
    areas.push_back(std::count_if(group.cells.begin(), group.cells.end(),
                                  [&](Index cell) { return silhouette.inside[static_cast<std::size_t>(cell)] != 0; }));
  return areas;
}

/// Whether the silhouette falls into several objects: into three of like size that are more than 8 cells apart, or two
/// that are more than 16 cells apart. The silhouette of one object may be broken too, where its colour is the table's:
/// of 700 rendered ones 2 % count as several.
bool is_clutter(const Silhouette& silhouette) {
  const auto number = [&](Index reach) { return effective_number(group_areas(silhouette, reach)); };
  return patches_of(silhouette.inside, 1, Neighbours::eight).size() > 1 && (number(4) > 2.5 || number(8) > 1.8);
}

/// The share of the rim, the outer twentieth of the circle's radius, that the silhouette covers.
double rim_share(const Silhouette& silhouette) {
  Index rim = 0, covered = 0;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column)
      if (in_circle(row, column) && static_cast<double>(squared_radius(row, column)) > squared_share(0.95)) {
        ++rim;
        covered += silhouette.inside[static_cast<std::size_t>(row * kSide + column)];
      }
  return static_cast<double>(covered) / static_cast<double>(rim);
}

Index circle_cells() {
  Index cells = 0;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column) cells += in_circle(row, column) ? 1 : 0;
  return cells;
}

}  // namespace

ObjectAxis axis_of(const Silhouette& silhouette) {
  constexpr double kLeastFill = 0.003, kMostFill = 0.8, kMostRim = 0.1, kRound = 0.85;
  constexpr double kCellVariance = 1.0 / 3;  // of a cell, 2 half cells wide, along either axis
  Index n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, yy_sum = 0, xy_sum = 0;
  for_cells(silhouette, [&](Index x, Index y) {
    ++n, x_sum += x, y_sum += y;
    xx_sum += x * x, yy_sum += y * y, xy_sum += x * y;
  });
  ObjectAxis axis;
  if (n == 0) return axis;
  const auto count = static_cast<double>(n);
  const Direction centroid{static_cast<double>(x_sum) / count, static_cast<double>(y_sum) / count};
  const double xx = static_cast<double>(xx_sum) / count - centroid.x * centroid.x + kCellVariance,
               yy = static_cast<double>(yy_sum) / count - centroid.y * centroid.y + kCellVariance,
               xy = static_cast<double>(xy_sum) / count - centroid.x * centroid.y;
  const double spread = std::hypot(xx - yy, 2 * xy);
  axis.elongation = std::sqrt(std::max(xx + yy - spread, 0.0) / (xx + yy + spread));
  axis.fill = count / static_cast<double>(circle_cells());

  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  Direction along{std::cos(angle), std::sin(angle)};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double first = kInfinity, last = -kInfinity, left = kInfinity, right = -kInfinity;
  for_cells(silhouette, [&](Index column, Index row) {
    const auto x = static_cast<double>(column), y = static_cast<double>(row);
    const double lengthwise = x * along.x + y * along.y, across = y * along.x - x * along.y;
    first = std::min(first, lengthwise), last = std::max(last, lengthwise);
    left = std::min(left, across), right = std::max(right, across);
  });
  const double extent = last - first + 2;  // from edge to edge of the cells
  axis.skew = (centroid.x * along.x + centroid.y * along.y - (first + last) / 2) / extent;
  if (axis.skew < 0) axis.skew = -axis.skew, along = {-along.x, -along.y};
  const double degrees = std::atan2(along.y, -along.x) * 180 / std::numbers::pi;
  axis.direction_deg = degrees < 0 ? degrees + 360 : degrees;
  if (axis.direction_deg >= 360) axis.direction_deg = 0;  // a tiny negative angle is rounded to 360
  axis.length = extent / static_cast<double>(2 * kSide);
  axis.width = (right - left + 2) / static_cast<double>(2 * kSide);

  if (axis.fill >= kLeastFill && axis.fill <= kMostFill && rim_share(silhouette) <= kMostRim && !is_clutter(silhouette))
    axis.kind = axis.elongation < kRound ? AxisKind::found : AxisKind::round;
  return axis;
}

}  // namespace svnet::frame
