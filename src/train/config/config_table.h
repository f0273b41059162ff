#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "train/config/config.h"
#include "train/config/strict_yaml.h"

namespace svnet {

/// One key bound to its field of a Config: the only declaration of the key.
struct BoundKey {
  std::string name;     ///< "scores.min_samples"
  std::string help;     ///< one sentence
  std::string accepts;  ///< "a whole number >= 0"
  /// Sets the field; relative paths are taken from `folder`.
  std::function<void(const YamlValue& value, const std::filesystem::path& folder)> read;
  /// The field as YAML; paths are written relative to `folder` where it is not empty.
  std::function<std::string(const std::filesystem::path& folder)> write;
};

/// All keys, section by section, bound to `config`, which must outlive them.
std::vector<BoundKey> bound_keys(Config& config);

}  // namespace svnet
