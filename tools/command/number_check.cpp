#include "command/number_check.h"

#include <cmath>
#include <functional>
#include <string>

#include "base/error.h"

namespace svnet::command {
namespace {

/// `expected`: the words after "must be" in the message.
CLI::Validator number_check(const std::string& expected, const std::function<bool(double)>& holds) {
  return {[=](std::string& text) -> std::string {
            double number = 0;
            if (!CLI::detail::lexical_cast(text, number)) return "'" + text + "' is not a number";
            return std::isfinite(number) && holds(number) ? "" : text + " is out of range, must be " + expected;
          },
          ""};
}

}  // namespace

CLI::Validator positive_number() {
  return number_check("greater than 0", [](double x) { return x > 0; });
}

CLI::Validator non_negative_number() {
  return number_check("at least 0", [](double x) { return x >= 0; });
}

CLI::Validator number_between(double low, double high) {
  return number_check(joined(low, " to ", high), [=](double x) { return x >= low && x <= high; });
}

}  // namespace svnet::command
