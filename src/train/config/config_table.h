#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "train/config/config.h"
#include "train/config/stage.h"
#include "train/config/strict_yaml.h"

namespace svnet::train {

/// One key bound to its field of a Config: the only declaration of the key.
struct BoundKey {
  std::string name;        ///< "scores.min_samples"
  Stage stage;             ///< the first stage whose result depends on the key; see fingerprint.h
  std::string help;        ///< one sentence
  std::string accepts;     ///< "a whole number >= 0"
  std::string value_name;  ///< how a command's help shows the value: "N", "{zero,skip}"
  /// Sets the field; relative paths are taken from `folder`. Throws Error that begins with value.where().
  std::function<void(const YamlValue& value, const std::filesystem::path& folder)> read;
  /// The field as YAML; paths are written relative to `folder` if it is not empty.
  std::function<std::string(const std::filesystem::path& folder)> write;
  /// false: with its default value the key is part of no fingerprint. For keys that came later, so that results from
  /// before them can be reused.
  bool default_counts = true;
};

/// All keys, section by section, bound to `config`, which must outlive them.
std::vector<BoundKey> bound_keys(Config& config);

/// The key of that name. Requires that there is one.
BoundKey bound_key(Config& config, const std::string& name);

}  // namespace svnet::train
