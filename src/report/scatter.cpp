#include "report/scatter.h"

#include <algorithm>
#include <cmath>

#include "report/markup.h"

namespace svnet::report {
namespace {

constexpr double kMapHeight = 332, kMapTop = 26, kMapSide = 300, kMapMargin = 8;
constexpr std::size_t kColours = 8, kShapes = 6;

/// A marker around (x, y). 48 groups have different ones.
std::string marker(double x, double y, std::size_t group) {
  const std::string tone = std::to_string(group % kColours);
  const auto path = [&](std::initializer_list<std::pair<double, double>> corners) {
    std::string d;
    for (const auto& [dx, dy] : corners) d += (d.empty() ? "M" : "L") + coordinate(x + dx) + " " + coordinate(y + dy);
    return empty_element("path", {{"d", d + "Z"}, {"class", "point fill-c" + tone}});
  };
  switch ((group % kColours + group / kColours) % kShapes) {
    case 0:
      return svg_circle(x, y, 3.6, "point fill-c" + tone);
    case 1:
      return path({{-3.3, -3.3}, {3.3, -3.3}, {3.3, 3.3}, {-3.3, 3.3}});
    case 2:
      return path({{0, -4.4}, {4.2, 3}, {-4.2, 3}});
    case 3:
      return path({{0, -4.8}, {4.8, 0}, {0, 4.8}, {-4.8, 0}});
    case 4:
      return path({{0, 4.4}, {4.2, -3}, {-4.2, -3}});
    default:  // a cross
      return path({{-1.4, -4.4},
                   {1.4, -4.4},
                   {1.4, -1.4},
                   {4.4, -1.4},
                   {4.4, 1.4},
                   {1.4, 1.4},
                   {1.4, 4.4},
                   {-1.4, 4.4},
                   {-1.4, 1.4},
                   {-4.4, 1.4},
                   {-4.4, -1.4},
                   {-1.4, -1.4}});
  }
}

}  // namespace

std::string scatter(const Scatter& map) {
  const ScatterLimits& limits = map.limits;
  const double inside_x = kPlotWidth - 4 * kMapMargin, inside_y = kMapSide - 4 * kMapMargin;
  const double extent_x = std::max(limits.high_x - limits.low_x, 1e-9),
               extent_y = std::max(limits.high_y - limits.low_y, 1e-9);
  const double scale = std::min(inside_x / extent_x, inside_y / extent_y);
  const double middle_x = (limits.low_x + limits.high_x) / 2, middle_y = (limits.low_y + limits.high_y) / 2;
  std::string inner =
      svg_text(0, 14, map.title, "start", "title") + empty_element("rect", {{"x", "0.5"},
                                                                            {"y", coordinate(kMapTop)},
                                                                            {"width", coordinate(kPlotWidth - 1)},
                                                                            {"height", coordinate(kMapSide)},
                                                                            {"class", "frame"}});
  for (const ScatterPoint& point : map.points)
    inner += marker(kPlotWidth / 2 + (point.x - middle_x) * scale,
                    kMapTop + kMapSide / 2 - (point.y - middle_y) * scale, point.group);
  return svg(kPlotWidth, kMapHeight, map.alternative, inner);
}

std::string scatter_legend(const std::vector<std::string>& groups) {
  std::string items;
  for (std::size_t group = 0; group < groups.size(); ++group)
    items += element(
        "li", element("svg", {{"aria-hidden", "true"}, {"width", "12"}, {"height", "12"}, {"viewBox", "0 0 12 12"}},
                      marker(6, 6, group)) +
                  escaped(groups[group]));
  return element("ul", {{"class", "legend"}}, items);
}

}  // namespace svnet::report
