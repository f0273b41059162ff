#pragma once
#include <cstddef>
#include <span>

namespace svnet::predict {

/// Throws Error for a value that is not finite: "[predict] feature 7 is nan, …". `first` is the index of the first
/// value.
void check_finite(std::span<const float> values, const char* what, std::size_t first = 0);

}  // namespace svnet::predict
