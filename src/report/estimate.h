#pragma once
#include <cmath>
#include <limits>

namespace svnet::report {

/// A mean with its 95 % interval over categories; NaN: not known.
struct Estimate {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();

  bool is_known() const { return std::isfinite(mean); }
  bool has_interval() const { return std::isfinite(low) && std::isfinite(high); }
  /// Whether a difference is sure: its interval excludes 0.
  bool is_sure() const { return has_interval() && (low > 0 || high < 0); }
};

}  // namespace svnet::report
