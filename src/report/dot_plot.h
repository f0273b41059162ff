#pragma once
#include <string>
#include <vector>

#include "report/estimate.h"

namespace svnet::report {

/// A line of a dot plot: a label, a dot at the mean, and a bar over the interval. A line without a known mean is a
/// heading of those below it.
struct DotRow {
  std::string label;
  Estimate value{};
  bool stands_out = false;
};

struct DotPlot {
  std::string title;
  std::string alternative;  ///< what the dots are, for the text that stands for the image; the values follow it
  std::vector<DotRow> rows;
  /// The values are differences: they have a sign, a line marks 0, and the dot of one that is not sure is hollow.
  bool differences = false;
};

/// The plot as SVG; nothing if no row has a value.
std::string dot_plot(const DotPlot& plot);

/// "+0.061 [+0.035, +0.088]", without brackets if there is no interval.
std::string estimate_text(const Estimate& estimate, bool difference);

}  // namespace svnet::report
