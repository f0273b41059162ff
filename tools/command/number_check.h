#pragma once
#include <CLI/CLI.hpp>

namespace svnet::command {

// Checks of floating-point options, for CLI::Option::check. They refuse NaN and infinities. CLI11's own checks accept
// NaN and print the largest double if a range has no upper end.

CLI::Validator positive_number();
CLI::Validator non_negative_number();
/// In [low, high].
CLI::Validator number_between(double low, double high);

}  // namespace svnet::command
