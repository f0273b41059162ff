#include "report/box_plot.h"

#include <algorithm>
#include <cmath>

#include "base/quantile.h"
#include "report/axis.h"
#include "report/markup.h"

namespace svnet::report {
namespace {

constexpr double kBoxLabels = 104, kBoxTop = 30, kBoxRow = 20, kBoxBottom = 24;

std::string box_row(const BoxRow& row, const Axis& axis, double y) {
  const auto x = [&](double value) { return axis.place(value); };
  const Box& box = row.box;
  std::string inner = element("title", escaped(row.label + ": median " + number(box.median) + ", middle half " +
                                               number(box.first_quartile) + " to " + number(box.third_quartile)));
  inner += svg_text(0, y + 4, shortened(row.label, 17)) + svg_line(x(box.low), y, x(box.high), y, "whisker") +
           empty_element("rect", {{"x", coordinate(x(box.first_quartile))},
                                  {"y", coordinate(y - 5)},
                                  {"width", coordinate(std::max(1.0, x(box.third_quartile) - x(box.first_quartile)))},
                                  {"height", "10"},
                                  {"class", "box"}}) +
           svg_line(x(box.median), y - 5, x(box.median), y + 5, "median");
  if (std::isfinite(row.top)) inner += svg_circle(x(row.top), y, 3.5, "dot other hollow");
  if (std::isfinite(row.chosen)) inner += svg_circle(x(row.chosen), y, 3.5, "dot accent");
  return element("g", inner);
}

}  // namespace

Box box_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.05), quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75),
          quantile(values, 0.95)};
}

std::string box_plot(const std::string& title, std::span<const BoxRow> rows) {
  double low = 1e300, high = -1e300;
  for (const BoxRow& row : rows) {
    low = std::min(low, row.box.low);
    high = std::max(high, row.box.high);
    for (const double mark : {row.chosen, row.top})
      if (std::isfinite(mark)) low = std::min(low, mark), high = std::max(high, mark);
  }
  const Axis axis = round_axis(low, high, 4, kBoxLabels + 8, kPlotWidth - 14);
  const double end = kBoxTop + kBoxRow * static_cast<double>(rows.size());
  std::string inner = svg_text(0, 14, title, "start", "title"), alternative = title + ".";
  for (const double tick : axis.ticks())
    inner += svg_line(axis.place(tick), kBoxTop - 4, axis.place(tick), end, "grid") +
             svg_text(axis.place(tick), end + 15, axis.tick_text(tick), "middle", "tick");
  double y = kBoxTop + kBoxRow / 2;
  for (const BoxRow& row : rows) {
    inner += box_row(row, axis, y);
    alternative += " " + row.label + ": median " + number(row.box.median, 2);
    if (std::isfinite(row.chosen)) alternative += ", SV-net's choices " + number(row.chosen, 2);
    if (std::isfinite(row.top)) alternative += ", top views " + number(row.top, 2);
    alternative += ".";
    y += kBoxRow;
  }
  return svg(kPlotWidth, end + kBoxBottom, alternative, inner);
}

}  // namespace svnet::report
