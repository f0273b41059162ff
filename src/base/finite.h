#pragma once
#include <cmath>
#include <cstddef>
#include <optional>

namespace svnet {

/// The index of the first value of a range of floats or doubles that is NaN or infinite, if there is one.
template <class Range>
std::optional<std::size_t> first_not_finite(const Range& values) {
  std::size_t i = 0;
  for (const auto value : values) {
    if (!std::isfinite(value)) return i;
    ++i;
  }
  return {};
}

}  // namespace svnet
