#pragma once
#include <string>
#include <vector>

#include "base/index.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace svnet::command {

/// An argument of a program, as Command::add returns it. Methods change it and return it; copies are the same argument.
/// CLI11 parses arguments, but takes seconds to compile: only the files of this folder include it.
class Argument {
 public:
  explicit Argument(CLI::Option* option) : option_(option) {}

  Argument required() const;
  /// What --help calls the value: FILE, DIR, NAME.
  Argument value_name(const std::string& name) const;

  // Checks. Floating-point numbers must be finite.
  Argument in_range(Index low, Index high) const;
  Argument in_interval(double low, double high) const;
  Argument positive() const;
  Argument non_negative() const;
  Argument one_of(const std::vector<std::string>& names) const;

  // Arguments that are lists.
  Argument separated_by_commas() const;
  Argument exactly(int values) const;
  /// Each use takes one value: --set a=1 --set b=2.
  Argument one_value_per_use() const;

  Argument needs(const Argument& other) const;
  Argument excludes(const Argument& other) const;

  /// --help shows the variable's value as the default, or `text`.
  Argument shows_default() const;
  Argument shows_default(const std::string& text) const;

  /// Whether the user gave it. After parsing.
  bool given() const;

 private:
  CLI::Option* option_;
};

}  // namespace svnet::command
