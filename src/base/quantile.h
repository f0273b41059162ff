#pragma once
#include <algorithm>
#include <span>

namespace svnet {

/// The quantile at `share` in [0, 1] of ascending values, linearly between ranks. Requires at least one value.
inline double quantile(std::span<const double> ascending, double share) {
  const double rank = share * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (rank - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

}  // namespace svnet
