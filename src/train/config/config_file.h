#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "train/config/config.h"
#include "train/config/stage.h"

namespace svnet::train {

/// Reads a configuration. `source` is the name of the text in messages. Relative paths in the text start at `folder`,
/// those in `overrides` ("key=value", applied in order) at the working directory. Throws Error with file, line and key.
Config parse_config(const std::string& text, const std::string& source, const std::filesystem::path& folder,
                    std::span<const std::string> overrides = {});

/// Reads the file: the only function here that touches the disk.
Config read_config(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Every key with its value: parse_config reads back an equal configuration. `folder`: of the file; without it, paths
/// are absolute. Paths below the folder's parent or grandparent are written relative to it, so that both can move
/// together.
std::string to_yaml(const Config& config, const std::filesystem::path& folder = {});

/// The same, each key below a comment with its meaning and what it accepts; paths are written relative to `folder`.
std::string documented_yaml(const Config& config, const std::filesystem::path& folder);

/// One key of the configuration, as help shows it.
struct ConfigKey {
  std::string name;           ///< "scores.min_samples"
  Stage stage;                ///< the first stage whose result depends on the key
  std::string help;           ///< its meaning
  std::string accepts;        ///< "a whole number >= 0"
  std::string default_value;  ///< as YAML
};
std::vector<ConfigKey> config_keys();

}  // namespace svnet::train
