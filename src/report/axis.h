#pragma once
#include <string>
#include <vector>

namespace svnet::report {

/// The values that an axis of a plot shows, with round ticks, and where they lie in it.
struct Axis {
  double low = 0, high = 1;  ///< values at the ends
  double step = 1;           ///< between ticks
  double from_px = 0, to_px = 1;

  double place(double value) const { return from_px + (value - low) / (high - low) * (to_px - from_px); }
  std::vector<double> ticks() const;
  /// A tick as text, with as many decimals as the step needs.
  std::string tick_text(double tick) const;
};

/// An axis from a multiple of the step at or below `low` to one at or above `high`, with about `intervals` steps of
/// 1, 2 or 5 times a power of ten. Values that are not finite, or equal, give an axis around what there is.
Axis round_axis(double low, double high, int intervals, double from_px, double to_px);

}  // namespace svnet::report
