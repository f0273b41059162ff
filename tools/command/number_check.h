#pragma once
#include <CLI/CLI.hpp>

namespace svnet {

// Checks of options that are real numbers, for CLI::Option::check. CLI11's own let NaN pass, and spell out the largest
// double where a range has no upper end. None of these takes NaN or an infinity.

CLI::Validator positive_number();
CLI::Validator non_negative_number();
/// Both ends belong to it.
CLI::Validator number_between(double low, double high);

}  // namespace svnet
