#pragma once
#include <span>
#include <string>
#include <vector>

namespace svnet::report {

/// How values are distributed.
struct Box {
  double low = 0, first_quartile = 0, median = 0, third_quartile = 0, high = 0;  ///< low, high: 5 % and 95 %
};
/// Quantiles, interpolated linearly. Requires a value; all must be finite.
Box box_of(std::vector<double> values);

struct BoxRow {
  std::string label;
  Box box;
  double chosen = 0, top = 0;  ///< marks on the line; NaN: none
};

/// Boxes below each other as SVG: a line from 5 % to 95 % of the values, a bar between the quartiles, a tick at the
/// median; a dot at `chosen`, a ring at `top`. Requires a row.
std::string box_plot(const std::string& title, std::span<const BoxRow> rows);

}  // namespace svnet::report
