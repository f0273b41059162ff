#include "command/argument.h"

#include <CLI/CLI.hpp>

#include "command/number_check.h"

namespace svnet::command {

Argument Argument::required() const { return Argument(option_->required()); }
Argument Argument::value_name(const std::string& name) const { return Argument(option_->type_name(name)); }

Argument Argument::in_range(Index low, Index high) const { return Argument(option_->check(CLI::Range(low, high))); }
Argument Argument::in_interval(double low, double high) const {
  return Argument(option_->check(number_between(low, high)));
}
Argument Argument::positive() const { return Argument(option_->check(positive_number())); }
Argument Argument::non_negative() const { return Argument(option_->check(non_negative_number())); }
Argument Argument::one_of(const std::vector<std::string>& names) const {
  return Argument(option_->check(CLI::IsMember(names)));
}

Argument Argument::separated_by_commas() const { return Argument(option_->delimiter(',')); }
Argument Argument::exactly(int values) const { return Argument(option_->expected(values)); }
Argument Argument::one_value_per_use() const { return Argument(option_->allow_extra_args(false)); }

Argument Argument::needs(const Argument& other) const { return Argument(option_->needs(other.option_)); }
Argument Argument::excludes(const Argument& other) const { return Argument(option_->excludes(other.option_)); }

Argument Argument::shows_default() const { return Argument(option_->capture_default_str()); }
Argument Argument::shows_default(const std::string& text) const { return Argument(option_->default_str(text)); }

bool Argument::given() const { return !option_->empty(); }

}  // namespace svnet::command
