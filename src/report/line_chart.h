#pragma once
#include <string>
#include <vector>

namespace svnet::report {

/// Values of epochs 1, 2, …, or of the steps of the chart; NaN: none.
struct Line {
  std::string label;
  std::vector<double> values;
};

struct LineChart {
  std::string title;
  std::vector<Line> lines;
  /// What the horizontal axis says at its two ends, and what it counts.
  std::string first{"epoch 1"}, last{};  ///< last empty: the number of the last epoch
  std::string along{"by epoch"};
  bool long_labels = false;  ///< more room for the labels, which then have no number
};

/// The chart as SVG, with each line's label and last value at its end; nothing if no line has a value.
std::string line_chart(const LineChart& chart);

}  // namespace svnet::report
