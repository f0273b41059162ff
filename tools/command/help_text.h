#pragma once
#include <CLI/CLI.hpp>

namespace svnet::command {

/// The format of --help: at most 80 columns; a value is shown by its name or choices, not by its C++ type; required
/// options are marked "(required)".
class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_description(const CLI::App* app) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace svnet::command
