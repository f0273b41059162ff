#include "frame/heights.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "frame/rise.h"

namespace svnet::frame {

Heights heights_of(const DepthImage& top_depth, const Silhouette& silhouette, const ObjectAxis& axis,
                   double focal_sides) {
  constexpr double kLeastMeasured = 0.25;
  check(focal_sides > 0 && std::isfinite(focal_sides), "[frame] the focal length is ", focal_sides,
        " sides of the image, expected a positive number");
  const Rise rise = rise_of(top_depth);
  std::vector<double> rises;
  Index cells = 0;
  for (std::size_t cell = 0; cell < silhouette.inside.size(); ++cell) {
    if (silhouette.inside[cell] == 0) continue;
    ++cells;
    if (!std::isnan(rise.metres[cell])) rises.push_back(std::max(rise.metres[cell], 0.0));
  }
  Heights heights;
  if (cells > 0) heights.measured = static_cast<double>(rises.size()) / static_cast<double>(cells);
  if (axis.kind == AxisKind::unclear || rises.empty() || heights.measured < kLeastMeasured) return heights;

  std::sort(rises.begin(), rises.end());
  const auto percentile = [&](double share) {
    return rises[static_cast<std::size_t>(share * static_cast<double>(rises.size() - 1))];
  };
  // Summed in ascending order: the order of the cells does not matter.
  double sum = 0;
  for (const double metres : rises) sum += metres;
  const double height_m = percentile(0.98), side_m = (rise.table_m - height_m / 2) / focal_sides,
               length_m = axis.length * side_m;
  if (!(length_m > 0)) return heights;
  heights.are_known = true;
  heights.height = height_m / length_m;
  heights.width = axis.width / axis.length;
  heights.mean_height = sum / static_cast<double>(rises.size()) / length_m;
  heights.flatness = height_m > 0 ? std::clamp(1 - (percentile(0.9) - percentile(0.1)) / height_m, 0.0, 1.0) : 1;
  heights.footprint = static_cast<double>(cells) / static_cast<double>(kCells) / (axis.length * axis.length);
  heights.volume = heights.mean_height * heights.footprint;
  return heights;
}

}  // namespace svnet::frame
