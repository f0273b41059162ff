#include "report/polar_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>

#include "report/markup.h"
#include "view/colour_scale.h"

namespace svnet::report {
namespace {

constexpr double kPolarWidth = 264, kPolarHeight = 292, kCentreX = 132, kCentreY = 140, kPolarRadius = 88;
constexpr double kWidestSector_deg = 45, kLowestStep_deg = 15;

struct PolarPoint {
  double x, y;
};

PolarPoint polar_point(double theta_deg, double radius) {
  const double theta = theta_deg * std::numbers::pi / 180;
  return {kCentreX - radius * std::cos(theta), kCentreY + radius * std::sin(theta)};
}

std::string place_text(const PolarPoint& p) { return coordinate(p.x) + " " + coordinate(p.y); }

/// The part of the half-sphere that is nearest to a view.
struct Cell {
  double low_theta_deg, high_theta_deg, inner, outer;  // radii in pixels
};

/// Cells of views: rings of equal elevation, each cut half-way between neighbouring azimuths.
class Cells {
 public:
  explicit Cells(const std::vector<PolarView>& views) {
    for (const PolarView& view : views) rings_[view.pose.phi_deg].insert(azimuth(view));
    lowest_deg_ = rings_.begin()->first;
    const double step = rings_.size() > 1 ? std::next(rings_.begin())->first - lowest_deg_ : kLowestStep_deg;
    lowest_deg_ -= std::min(step, 2 * kLowestStep_deg) / 2;
    if (lowest_deg_ > 89) lowest_deg_ = 75;
  }

  double radius(double phi_deg) const { return kPolarRadius * (90 - phi_deg) / (90 - lowest_deg_); }
  /// From the lowest on.
  std::vector<double> elevations() const {
    std::vector<double> elevations;
    for (const auto& [phi, thetas] : rings_) elevations.push_back(phi);
    return elevations;
  }

  Cell of(const PolarView& view) const {
    const auto ring = rings_.find(view.pose.phi_deg);
    const double below = ring == rings_.begin() ? lowest_deg_ : (std::prev(ring)->first + ring->first) / 2;
    const double above = std::next(ring) == rings_.end() ? 90 : (std::next(ring)->first + ring->first) / 2;
    if (view.pose.phi_deg >= 90) return {0, 360, 0, radius(below)};
    const auto [before, after] = halves(ring->second, azimuth(view));
    return {azimuth(view) - before, azimuth(view) + after, radius(above), radius(below)};
  }

 private:
  static double azimuth(const PolarView& view) { return std::fmod(view.pose.theta_deg + 720, 360); }

  /// Half of the way to the neighbours before and after `theta`; where a view is missing, no more than on the other
  /// side of the narrowest sector.
  static std::pair<double, double> halves(const std::set<double>& thetas, double theta) {
    if (thetas.size() == 1) return {kWidestSector_deg / 2, kWidestSector_deg / 2};
    double narrowest = 360;
    for (auto i = thetas.begin(); i != thetas.end(); ++i) narrowest = std::min(narrowest, gap_after(thetas, *i));
    const double most = std::min(kWidestSector_deg, narrowest) / 2;
    const auto here = thetas.find(theta);
    const double previous = here == thetas.begin() ? *thetas.rbegin() : *std::prev(here);
    return {std::min(gap_after(thetas, previous) / 2, most), std::min(gap_after(thetas, theta) / 2, most)};
  }
  static double gap_after(const std::set<double>& thetas, double theta) {
    const auto next = std::next(thetas.find(theta));
    return next == thetas.end() ? *thetas.begin() + 360 - theta : *next - theta;
  }

  std::map<double, std::set<double>> rings_{};
  double lowest_deg_ = 0;
};

std::string outline(const Cell& cell) {
  if (cell.high_theta_deg - cell.low_theta_deg >= 359.9) {
    const std::string r = coordinate(cell.outer);
    return "M" + place_text(polar_point(0, cell.outer)) + "A" + r + " " + r + " 0 1 0 " +
           place_text(polar_point(180, cell.outer)) + "A" + r + " " + r + " 0 1 0 " +
           place_text(polar_point(360, cell.outer)) + "Z";
  }
  const std::string inner = coordinate(cell.inner), outer = coordinate(cell.outer);
  return "M" + place_text(polar_point(cell.low_theta_deg, cell.inner)) + "L" +
         place_text(polar_point(cell.low_theta_deg, cell.outer)) + "A" + outer + " " + outer + " 0 0 0 " +
         place_text(polar_point(cell.high_theta_deg, cell.outer)) + "L" +
         place_text(polar_point(cell.high_theta_deg, cell.inner)) + "A" + inner + " " + inner + " 0 0 1 " +
         place_text(polar_point(cell.low_theta_deg, cell.inner)) + "Z";
}

std::string hex(const view::Colour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(std::lround(colour[0])),
                static_cast<unsigned>(std::lround(colour[1])), static_cast<unsigned>(std::lround(colour[2])));
  return text;
}

struct ScoreRange {
  double low, high;
  std::string colour(double score) const {
    return hex(view::scale_colour(high > low ? (score - low) / (high - low) : 1));
  }
};

ScoreRange range_of(const std::vector<PolarView>& views) {
  ScoreRange range{1e300, -1e300};
  for (const PolarView& view : views)
    if (std::isfinite(view.score)) range = {std::min(range.low, view.score), std::max(range.high, view.score)};
  return range.low <= range.high ? range : ScoreRange{0, 0};
}

std::string view_marks(const PolarMap& map, const Cells& cells) {
  std::string inner;
  for (const auto& [index, name] : {std::pair{map.worst, "worst"}, {map.best, "best"}})
    if (index) {
      const std::string shape = outline(cells.of(map.views[*index]));
      inner += empty_element("path", {{"d", shape}, {"class", "mark halo"}});
      inner += empty_element("path", {{"d", shape}, {"class", std::string("mark ") + name}});
    }
  if (map.chosen) {
    const PolarView& view = map.views[*map.chosen];
    const PolarPoint centre = polar_point(view.pose.theta_deg, cells.radius(view.pose.phi_deg));
    inner += svg_circle(centre.x, centre.y, 5.5, "chosen");
  }
  return inner;
}

std::string polar_labels(const PolarMap& map, const Cells& cells) {
  const double rim = kPolarRadius + 6;
  std::string inner = svg_text(kCentreX, 16, map.title, "middle", "title") +
                      svg_text(kCentreX - rim, kCentreY + 4, "0°", "end", "tick") +
                      svg_text(kCentreX, kCentreY + rim + 9, "90°", "middle", "tick") +
                      svg_text(kCentreX + rim, kCentreY + 4, "180°", "start", "tick") +
                      svg_text(kCentreX, kCentreY - rim - 1, "270°", "middle", "tick");
  const std::vector<double> elevations = cells.elevations();
  if (elevations.size() <= 5)
    for (const double phi : elevations)
      if (phi < 90) {
        const PolarPoint p = polar_point(292.5, cells.radius(phi));
        inner += svg_text(p.x, p.y + 3, "φ " + coordinate(phi), "middle", "ring");
      }
  return inner;
}

std::string colour_bar(const ScoreRange& range) {
  constexpr int kSteps = 24;
  constexpr double kLeft = 72, kY = 268, kStep = 120.0 / kSteps;
  std::string inner;
  for (int i = 0; i < kSteps; ++i)
    inner += empty_element("rect", {{"x", coordinate(kLeft + i * kStep)},
                                    {"y", coordinate(kY)},
                                    {"width", coordinate(kStep + 0.3)},
                                    {"height", "9"},
                                    {"shape-rendering", "crispEdges"},
                                    {"fill", hex(view::scale_colour((i + 0.5) / kSteps))}});
  return inner + svg_text(kLeft - 6, kY + 9, number(range.low, 2), "end", "tick") +
         svg_text(kLeft + 126, kY + 9, number(range.high, 2), "start", "tick");
}

}  // namespace

std::string polar_map(const PolarMap& map) {
  const Cells cells(map.views);
  const ScoreRange range = range_of(map.views);
  std::string inner;
  for (const PolarView& view : map.views) {
    const bool known = std::isfinite(view.score);
    inner += element("path",
                     {{"d", outline(cells.of(view))},
                      known ? Attribute{"fill", range.colour(view.score)} : Attribute{"class", "unknown"}},
                     element("title", "θ " + coordinate(view.pose.theta_deg) + "°, φ " + coordinate(view.pose.phi_deg) +
                                          "°: " + number(view.score)));
  }
  if (map.axis_deg) {
    const PolarPoint heavy = polar_point(*map.axis_deg, kPolarRadius + 2),
                     light = polar_point(*map.axis_deg + 180, kPolarRadius + 2);
    inner += svg_line(light.x, light.y, heavy.x, heavy.y, "object-axis");
  }
  return svg(kPolarWidth, kPolarHeight, map.alternative,
             inner + view_marks(map, cells) + polar_labels(map, cells) + colour_bar(range));
}

}  // namespace svnet::report
