#include "train/config/fingerprint.h"

#include <cassert>
#include <map>

#include "base/sha256.h"
#include "train/config/config_table.h"

namespace svnet::train {
namespace {

/// How a stage makes its result. Raise the number when the same inputs and keys give another result than before.
const char* method_of(Stage stage) {
  switch (stage) {
    case Stage::features:
      break;  // see features_origin
    case Stage::scores:
      return "scores 2";
    case Stage::model:
      return "model 5";
    case Stage::evaluation:
      return "evaluation 1";
  }
  return "";
}

}  // namespace

std::string stage_fingerprint(Stage stage, std::span<const std::string> inputs, const Config& config) {
  assert(stage != Stage::features);
  Config copy = config, defaults;
  const std::vector<BoundKey> keys = bound_keys(copy), default_keys = bound_keys(defaults);
  std::map<std::string, std::string> values;  // sorted, so that the order of the table does not matter
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string value = keys[i].write({});
    const bool counts = keys[i].default_counts || value != default_keys[i].write({});
    if (keys[i].stage == stage && counts) values[keys[i].name] = value;
  }
  Sha256 hash;
  hash.update_field(method_of(stage));
  for (const std::string& input : inputs) hash.update_field(input);
  for (const auto& [name, value] : values) hash.update_field(name).update_field(value);
  return hash.hex();
}

std::string scores_fingerprint(const std::string& features_fingerprint, const Config& config) {
  return stage_fingerprint(Stage::scores, std::span(&features_fingerprint, 1), config);
}

std::string scores_fingerprint(const std::string& features_fingerprint, const semantics::ViewWeights& weights,
                               const Config& config) {
  Sha256 bytes;
  bytes.update(weights.data(), weights.size() * sizeof(double));
  const std::string inputs[] = {features_fingerprint, "view weights", bytes.hex()};
  return stage_fingerprint(Stage::scores, inputs, config);
}

std::string mean_scores_fingerprint(std::span<const std::string> scores, const Config& config) {
  std::vector<std::string> inputs{"mean"};
  inputs.insert(inputs.end(), scores.begin(), scores.end());
  return stage_fingerprint(Stage::scores, inputs, config);
}

std::string model_fingerprint(const std::string& features, const std::string& scores, const Config& config) {
  const std::string inputs[] = {features, scores};
  return stage_fingerprint(Stage::model, inputs, config);
}

}  // namespace svnet::train
