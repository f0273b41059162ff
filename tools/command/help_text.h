#pragma once
#include <CLI/CLI.hpp>

namespace svnet {

/// How --help reads: no line longer than 80 columns, values by their names and choices rather than by their C++ types,
/// "(required)" where an option is.
class HelpText : public CLI::Formatter {
 public:
  HelpText();
  std::string make_description(const CLI::App* app) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace svnet
