#include "frame/rise.h"

#include <limits>

#include "base/error.h"
#include "frame/reduce.h"
#include "frame/table_plane.h"

namespace svnet::frame {

Rise rise_of(const DepthImage& depth) {
  // Inverse depth as integers, kInverse / depth in micrometres: a millionth of 10 m, and below 2^30 from 1 cm on.
  constexpr std::int64_t kInverse = 10'000'000'000'000, kNearest_um = 10'000;
  const Grid<std::int64_t> depth_um = reduced_depth_um(depth);
  std::vector<std::int64_t> inverse(depth_um.size());
  Grid<std::uint8_t> measured(depth_um.size());
  for (std::size_t cell = 0; cell < depth_um.size(); ++cell)
    if (depth_um[cell] >= kNearest_um) inverse[cell] = kInverse / depth_um[cell], measured[cell] = 1;
  const TablePlane table = fit_table(inverse, 1, measured);

  const auto metres = [](double inverse_depth) { return static_cast<double>(kInverse) / inverse_depth * 1e-6; };
  const Plane& plane = table.planes.front();
  check(plane.level > 0, "[frame] the depth of the table cannot be told from the ring along the inscribed circle");
  Rise rise{Grid<double>(depth_um.size(), std::numeric_limits<double>::quiet_NaN()), metres(plane.level), 0};
  rise.noise_m = table.noise / plane.level * rise.table_m;
  for (Index cell = 0; cell < kCells; ++cell) {
    const auto at = static_cast<std::size_t>(cell);
    const double table_here = plane.at(cell / kSide, cell % kSide);
    if (measured[at] != 0 && table_here > 0)
      rise.metres[at] = metres(table_here) - static_cast<double>(depth_um[at]) * 1e-6;
  }
  return rise;
}

}  // namespace svnet::frame
