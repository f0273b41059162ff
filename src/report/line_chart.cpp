#include "report/line_chart.h"

#include <algorithm>
#include <cmath>

#include "report/axis.h"
#include "report/markup.h"

namespace svnet::report {
namespace {

constexpr double kChartHeight = 208, kChartTop = 34, kChartBottom = 178, kChartLeft = 44, kLabelGap = 14;
constexpr double kChartRight = 236, kEarlyRight = 206;  // early: with long labels
constexpr std::size_t kShort = 18, kLong = 21;          // letters of a label

struct EndLabel {
  std::string text, style_class;
  double y;
};

/// Moves labels apart that would overlap, in the order of their height.
void spread(std::vector<EndLabel>& labels) {
  std::stable_sort(labels.begin(), labels.end(), [](const EndLabel& a, const EndLabel& b) { return a.y < b.y; });
  for (std::size_t i = 1; i < labels.size(); ++i) labels[i].y = std::max(labels[i].y, labels[i - 1].y + kLabelGap);
}

}  // namespace

std::string line_chart(const LineChart& chart) {
  double low = 1e300, high = -1e300;
  std::size_t epochs = 1;
  for (const Line& line : chart.lines)
    for (std::size_t i = 0; i < line.values.size(); ++i)
      if (const double value = line.values[i]; std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
        epochs = std::max(epochs, i + 1);
      }
  if (low > high) return "";
  const double right = chart.long_labels ? kEarlyRight : kChartRight;
  const Axis y = round_axis(low, high, 4, kChartBottom, kChartTop);
  const double last = static_cast<double>(std::max<std::size_t>(epochs, 2));
  const auto x = [&](double epoch) { return kChartLeft + (epoch - 1) / (last - 1) * (right - kChartLeft); };

  std::string inner = svg_text(0, 14, chart.title, "start", "title");
  for (const double tick : y.ticks())
    inner += svg_line(kChartLeft, y.place(tick), right, y.place(tick), "grid") +
             svg_text(kChartLeft - 8, y.place(tick) + 4, y.tick_text(tick), "end", "tick");
  inner += svg_text(kChartLeft, kChartBottom + 18, chart.first, "start", "tick") +
           svg_text(right, kChartBottom + 18, chart.last.empty() ? std::to_string(epochs) : chart.last, "end", "tick");
  std::string alternative = chart.title + " " + chart.along + ".";
  std::vector<EndLabel> labels;
  for (std::size_t l = 0; l < chart.lines.size(); ++l) {
    const Line& line = chart.lines[l];
    std::string points;
    double first_value = std::nan(""), last_value = first_value;
    for (std::size_t i = 0; i < line.values.size(); ++i) {
      if (!std::isfinite(line.values[i])) continue;
      if (points.empty()) first_value = line.values[i];
      last_value = line.values[i];
      points += (points.empty() ? "" : " ") + coordinate(x(static_cast<double>(i + 1))) + "," +
                coordinate(y.place(last_value));
    }
    if (points.empty()) continue;
    const std::string tone = "c" + std::to_string(l % 8);
    inner += empty_element("polyline", {{"points", points}, {"class", "curve stroke-" + tone}});
    labels.push_back(
        {chart.long_labels ? shortened(line.label, kLong) : shortened(line.label + " " + number(last_value), kShort),
         "fill-" + tone, y.place(last_value) + 4});
    alternative += " " + line.label + ": from " + number(first_value) + " to " + number(last_value) + ".";
  }
  spread(labels);
  double lowest = kChartHeight;
  for (const EndLabel& label : labels) {
    inner += svg_text(right + 8, label.y, label.text, "start", label.style_class.c_str());
    lowest = std::max(lowest, label.y + 6);
  }
  return svg(kPlotWidth, lowest, alternative, inner);
}

}  // namespace svnet::report
