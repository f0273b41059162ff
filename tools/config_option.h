#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "train/config/config.h"

namespace svnet {

/// Adds an option that sets a key of the configuration, with the help, the range and the names that the key has in a
/// configuration file. `config` must outlive the parsing; what it holds now is the default that --help shows.
CLI::Option* add_config_option(CLI::App& app, Config& config, const std::string& option, const std::string& key);

}  // namespace svnet
