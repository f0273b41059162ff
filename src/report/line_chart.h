#pragma once
#include <string>
#include <vector>

namespace svnet::report {

/// Values of epochs 1, 2, …; NaN: none.
struct Line {
  std::string label;
  std::vector<double> values;
};

struct LineChart {
  std::string title;
  std::vector<Line> lines;
};

/// The chart as SVG, with each line's label at its end; nothing if no line has a value.
std::string line_chart(const LineChart& chart);

}  // namespace svnet::report
