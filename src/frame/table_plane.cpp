#include "frame/table_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/error.h"

namespace svnet::frame {
namespace {

/// A cell of the ring with its weight in the fit, 0 to kFullWeight.
struct RingCell {
  Index row, column;
  Index weight;
};
constexpr Index kFullWeight = 1024;

/// Every other cell, as on a chessboard, in a pattern that turns and mirrors keep: half of the ring says enough.
bool is_white(Index row, Index column) { return std::abs(half_cells(row)) % 4 == std::abs(half_cells(column)) % 4; }

std::size_t cell_of(const RingCell& cell) { return static_cast<std::size_t>(cell.row * kSide + cell.column); }

/// The value at `share` of the sorted values.
double quantile(std::vector<double> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The planes of least weighted squares. Written so that exchanging or negating the axes exchanges or negates the
/// slopes without a change of a bit.
std::vector<Plane> least_squares(const std::vector<RingCell>& ring, const std::vector<std::int64_t>& values,
                                 Index channels) {
  Index n = 0, x_sum = 0, y_sum = 0, xx_sum = 0, yy_sum = 0, xy_sum = 0;
  struct Sums {
    Index v = 0, xv = 0, yv = 0;
  };
  std::vector<Sums> sums(static_cast<std::size_t>(channels));
  for (const RingCell& cell : ring) {
    if (cell.weight == 0) continue;
    const Index x = half_cells(cell.column), y = half_cells(cell.row), w = cell.weight;
    n += w, x_sum += w * x, y_sum += w * y;
    xx_sum += w * x * x, yy_sum += w * y * y, xy_sum += w * x * y;
    for (Index c = 0; c < channels; ++c) {
      const Index v = values[cell_of(cell) * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)];
      Sums& sum = sums[static_cast<std::size_t>(c)];
      sum.v += w * v, sum.xv += w * x * v, sum.yv += w * y * v;
    }
  }
  const auto count = static_cast<double>(n), sx = static_cast<double>(x_sum), sy = static_cast<double>(y_sum);
  const double xx = static_cast<double>(xx_sum) - sx * sx / count, yy = static_cast<double>(yy_sum) - sy * sy / count,
               xy = static_cast<double>(xy_sum) - sx * sy / count;
  // Cells on one side alone say too little about the slope across: then the table counts as level.
  const double determinant = xx * yy - xy * xy;
  const bool is_steady = determinant > 1e-3 * (xx + yy) * (xx + yy);
  std::vector<Plane> planes;
  for (const Sums& sum : sums) {
    const auto sv = static_cast<double>(sum.v);
    const double xv = static_cast<double>(sum.xv) - sx * sv / count, yv = static_cast<double>(sum.yv) - sy * sv / count;
    Plane plane;
    if (is_steady) {
      plane.along_x = (xv * yy - yv * xy) / determinant;
      plane.along_y = (yv * xx - xv * xy) / determinant;
    }
    plane.level = (sv - (plane.along_x * sx + plane.along_y * sy)) / count;
    planes.push_back(plane);
  }
  return planes;
}

/// The distance of each cell's values from the planes, over all channels.
std::vector<double> distances(const std::vector<RingCell>& ring, const std::vector<std::int64_t>& values,
                              const std::vector<Plane>& planes) {
  std::vector<double> result;
  result.reserve(ring.size());
  for (const RingCell& cell : ring) {
    double sum = 0;
    for (std::size_t c = 0; c < planes.size(); ++c) {
      const double step =
          static_cast<double>(values[cell_of(cell) * planes.size() + c]) - planes[c].at(cell.row, cell.column);
      sum += step * step;
    }
    result.push_back(std::sqrt(sum));
  }
  return result;
}

}  // namespace

TablePlane fit_table(const std::vector<std::int64_t>& values, Index channels, const Grid<std::uint8_t>& measured) {
  constexpr double kNearest = 0.6, kTukey = 4.685;
  constexpr int kMostStarts = 6, kRounds = 3;
  std::vector<RingCell> ring;
  std::size_t ring_cells = 0;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column)
      if (in_ring(row, column) && is_white(row, column)) {
        ++ring_cells;
        if (measured[static_cast<std::size_t>(row * kSide + column)] != 0) ring.push_back({row, column, kFullWeight});
      }
  check(10 * ring.size() >= ring_cells,
        "[frame] the table cannot be seen: of the ring along the image's inscribed "
        "circle ",
        ring.size(), " of ", ring_cells, " cells were measured, at least a tenth is needed");

  TablePlane table;
  // Medians first: the plane of least squares follows an object in the ring too far to find its way back.
  for (Index c = 0; c < channels; ++c) {
    std::vector<double> channel;
    channel.reserve(ring.size());
    for (const RingCell& cell : ring)
      channel.push_back(static_cast<double>(
          values[cell_of(cell) * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)]));
    table.planes.push_back({quantile(channel, 0.5), 0, 0});
  }
  std::vector<double> distance = distances(ring, values, table.planes);
  // Fits anew with these weights; false if they are the present ones, which would change nothing.
  const auto refit = [&](const auto& weight) {
    bool is_new = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Index before = std::exchange(ring[i].weight, weight(distance[i]));
      is_new = is_new || before != ring[i].weight;
    }
    if (!is_new) return false;
    table.planes = least_squares(ring, values, channels);
    distance = distances(ring, values, table.planes);
    return true;
  };
  for (int i = 0; i < kMostStarts; ++i) {
    const double limit = quantile(distance, kNearest);
    if (!refit([&](double d) { return d <= limit ? kFullWeight : Index{0}; })) break;
  }
  // The median distance of normal noise of one channel is .674 sd, of three channels 1.538 sd.
  const double of_median = channels == 1 ? 0.6745 : 1.538;
  for (int i = 0; i < kRounds; ++i) {
    table.noise = std::max(quantile(distance, 0.5) / of_median, 1e-9);
    const double limit = kTukey * table.noise * std::sqrt(static_cast<double>(channels));
    if (!refit([&](double d) {
          const double t = d < limit ? 1 - (d / limit) * (d / limit) : 0;
          return static_cast<Index>(static_cast<double>(kFullWeight) * t * t);
        }))
      break;
  }
  table.noise = quantile(distance, 0.5) / of_median;
  return table;
}

}  // namespace svnet::frame
