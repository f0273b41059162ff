#pragma once
#include <string>
#include <vector>

namespace svnet::report {

/// A point of a map; `group` chooses its colour and shape.
struct ScatterPoint {
  double x = 0, y = 0;
  std::size_t group = 0;
};

/// Limits of a map, so that several can share them.
struct ScatterLimits {
  double low_x, high_x, low_y, high_y;
};

struct Scatter {
  std::string title;
  std::string alternative;  ///< the text that stands for the image
  std::vector<ScatterPoint> points;
  ScatterLimits limits;
};

/// The map as SVG, with the same scale along both axes.
std::string scatter(const Scatter& map);

/// The names of the groups beside their markers, as an HTML list.
std::string scatter_legend(const std::vector<std::string>& groups);

}  // namespace svnet::report
