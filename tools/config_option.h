#pragma once
#include <string>

#include "command/command.h"
#include "train/config/config.h"

namespace svnet {

/// Adds an option that sets a key of the configuration, with the help, the range and the names that the key has in a
/// configuration file. `config` must outlive the parsing; what it holds now is the default that --help shows.
command::Argument add_config_option(command::Command& command, train::Config& config, const std::string& option,
                                    const std::string& key);

}  // namespace svnet
