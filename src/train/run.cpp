#include "train/run.h"

#include <algorithm>

#include "base/parallel.h"
#include "io/atomic_file.h"
#include "train/feature_extraction.h"

namespace svnet {
namespace {

namespace fs = std::filesystem;

/// What `read` returns, or nothing where the file does not exist or cannot be used; then it is made again.
template <class Read>
auto read_if_possible(const fs::path& path, const Messages& messages, Read read)
    -> std::optional<decltype(read(path))> {
  if (!fs::exists(path)) return {};
  try {
    return read(path);
  } catch (const Error& error) {
    if (messages.line) messages.line(joined("made again: ", error.what()));
    return {};
  }
}

}  // namespace

Run::Run(Config config, ViewDataset dataset, fs::path folder, const Messages& messages)
    : config_(std::move(config)),
      folder_(std::move(folder)),
      messages_(messages),
      dataset_(std::move(dataset)),
      held_out_(named_categories(dataset_, config_.dataset.held_out, "dataset.held_out")) {
  const auto training = std::count(held_out_.begin(), held_out_.end(), false);
  check(training >= 2, "dataset.held_out: leaves ", training, " categories to train on, at least 2 are needed");
  std::error_code error;
  fs::create_directories(folder_, error);
  check(!error, folder_.string(), ": cannot make this folder: ", error.message());
  dataset_fingerprint_ = fingerprint(dataset_, Parallel::shared());
  say(joined("dataset ", config_.dataset.root.string(), ": ", dataset_.categories.size(), " categories, ",
             dataset_.objects.size(), " objects, ", dataset_.poses.size(), " poses, ", dataset_.views.size(),
             " views"));
  write_atomically(folder_ / "config.yaml", to_yaml(config_));
}

void Run::say(const std::string& line) const {
  if (messages_.line) messages_.line(line);
}

const Features& Run::features(const std::string& backbone, const std::string& layer) {
  const fs::path path = folder_ / ("features-" + backbone + (layer.empty() ? "" : "-" + layer) + ".h5");
  const auto found = features_.find(path);
  return found != features_.end() ? found->second
                                  : features_.emplace(path, made_features(path, backbone, layer)).first->second;
}

Features Run::made_features(const fs::path& path, const std::string& backbone, const std::string& layer) const {
  const auto source =
      backbone_from_folder(backbone, layer, config_.weights.folder, static_cast<std::uint64_t>(config_.seed));
  const FeaturesOrigin origin = features_origin(source, dataset_fingerprint_);
  const auto have = read_if_possible(path, messages_, read_features_origin);
  if (have && have->input_fingerprint == origin.input_fingerprint)
    if (auto features = read_if_possible(path, messages_, read_features)) {
      say(joined("features of ", backbone, ": reused ", path.filename().string()));
      return std::move(*features);
    }
  Features features = extract_features(source.backbone, dataset_, origin, messages_);
  write_features(path, features);
  return features;
}

}  // namespace svnet
