#include "report/dot_plot.h"

#include <algorithm>

#include "report/axis.h"
#include "report/markup.h"

namespace svnet::report {
namespace {

constexpr double kDotLabels = 126, kDotValues = 46, kDotTop = 30, kDotRow = 22, kDotBottom = 24;

Axis dot_axis(const DotPlot& plot) {
  double low = plot.differences ? 0 : 1e300, high = plot.differences ? 0 : -1e300;
  for (const DotRow& row : plot.rows) {
    if (!row.value.is_known()) continue;
    low = std::min({low, row.value.mean, row.value.has_interval() ? row.value.low : row.value.mean});
    high = std::max({high, row.value.mean, row.value.has_interval() ? row.value.high : row.value.mean});
  }
  return round_axis(low, high, 3, kDotLabels + 10, kPlotWidth - kDotValues - 10);
}

std::string dot_row(const DotRow& row, const Axis& axis, double y, bool differences) {
  if (!row.value.is_known()) return svg_text(0, y + 4, shortened(row.label, 40), "start", "strong");
  const char* tone = row.stands_out ? "accent" : "other";
  std::string inner = svg_text(0, y + 4, shortened(row.label, 21), "start", row.stands_out ? "strong" : "");
  if (row.value.has_interval())
    inner += svg_line(axis.place(row.value.low), y, axis.place(row.value.high), y,
                      row.stands_out ? "bar accent" : "bar other");
  const bool hollow = differences && !row.value.is_sure();
  inner += svg_circle(axis.place(row.value.mean), y, row.stands_out ? 5 : 4,
                      std::string("dot ") + tone + (hollow ? " hollow" : ""));
  inner += svg_text(kPlotWidth, y + 4, differences ? signed_number(row.value.mean) : number(row.value.mean), "end",
                    row.stands_out ? "strong" : "");
  return element("g", element("title", escaped(row.label + ": " + estimate_text(row.value, differences))) + inner);
}

}  // namespace

std::string estimate_text(const Estimate& estimate, bool difference) {
  const auto text = [&](double value) { return difference ? signed_number(value) : number(value); };
  if (!estimate.has_interval()) return text(estimate.mean);
  return text(estimate.mean) + " [" + text(estimate.low) + ", " + text(estimate.high) + "]";
}

std::string dot_plot(const DotPlot& plot) {
  if (std::none_of(plot.rows.begin(), plot.rows.end(), [](const DotRow& row) { return row.value.is_known(); }))
    return "";
  const Axis axis = dot_axis(plot);
  const double end = kDotTop + kDotRow * static_cast<double>(plot.rows.size());
  std::string inner = svg_text(0, 14, plot.title, "start", "title"), alternative = plot.alternative + ".";
  for (const double tick : axis.ticks()) {
    const bool zero = plot.differences && std::abs(tick) < axis.step / 2;
    inner += svg_line(axis.place(tick), kDotTop - 4, axis.place(tick), end, zero ? "zero" : "grid");
    inner += svg_text(axis.place(tick), end + 15, axis.tick_text(tick), "middle", "tick");
  }
  double y = kDotTop + kDotRow / 2;
  for (const DotRow& row : plot.rows) {
    inner += dot_row(row, axis, y, plot.differences);
    alternative += row.value.is_known() ? " " + row.label + ": " + estimate_text(row.value, plot.differences) + "."
                                        : " " + row.label + ".";
    y += kDotRow;
  }
  return svg(kPlotWidth, end + kDotBottom, plot.title + ". " + alternative, inner);
}

}  // namespace svnet::report
