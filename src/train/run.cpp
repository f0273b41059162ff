#include "train/run.h"

#include <algorithm>

#include "base/parallel.h"
#include "io/views/dataset_folder.h"
#include "train/reused_file.h"
#include "train/scores_stage.h"
#include "train/trained_from.h"

namespace svnet {
namespace fs = std::filesystem;

Run::Run(Config config, ViewDataset dataset, fs::path folder, const Messages& messages, Communicator& communicator)
    : config_(std::move(config)),
      folder_(std::move(folder)),
      messages_(messages),
      communicator_(communicator),
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
  check_config();
}

void Run::check_config() {
  const auto check_backbone = [&](const std::string& name, const std::string& layer) {
    const BackboneKind& kind = backbone_kind(name);
    output_layer(kind, kind.graph(kind.preprocessing.height, true), layer);
    check_weights(name, config_.weights.folder);
  };
  check_backbone(config_.scores.backbone, config_.scores.layer);
  check_backbone(config_.sv_net.backbone, config_.sv_net.layer);
  const BackboneKind& tuned = backbone_kind(config_.sv_net.backbone);
  const Graph graph = tuned.graph(tuned.preprocessing.height, true);
  static_cast<void>(
      trained_from(config_.training.fine_tune, tuned, graph, output_layer(tuned, graph, config_.sv_net.layer)));
  for (const auto& name : config_.evaluation.pipelines)
    check_backbone(parse_pipeline(name, "evaluation.pipelines").backbone, "");
  static_cast<void>(validation_categories());
  clustering_problems(dataset_, held_out_, config_.scores);
  if (std::count(held_out_.begin(), held_out_.end(), true) >= 2) {
    std::vector<bool> trained_on = held_out_;
    trained_on.flip();
    clustering_problems(dataset_, trained_on, config_.scores);
  }
}

const BackboneWithOrigin& Run::backbone(const std::string& name, const std::string& layer) {
  const std::string key = name + "/" + layer;
  const auto found = backbones_.find(key);
  if (found != backbones_.end()) return found->second;
  return backbones_
      .emplace(key, backbone_from_folder(name, layer, config_.weights.folder, static_cast<std::uint64_t>(config_.seed)))
      .first->second;
}

std::string Run::features_fingerprint(const std::string& name, const std::string& layer) {
  return features_origin(backbone(name, layer), dataset_fingerprint_).input_fingerprint;
}

void Run::say(const std::string& line) const {
  if (messages_.line) messages_.line(line);
}

const Features& Run::features(const std::string& name, const std::string& layer) {
  const fs::path path = folder_ / ("features-" + name + (layer.empty() ? "" : "-" + layer) + ".h5");
  const auto found = features_.find(path);
  return found != features_.end() ? found->second
                                  : features_.emplace(path, made_features(path, name, layer)).first->second;
}

Features Run::made_features(const fs::path& path, const std::string& name, const std::string& layer) {
  const BackboneWithOrigin& source = backbone(name, layer);
  const FeaturesOrigin origin = features_origin(source, dataset_fingerprint_);
  if (auto features = reused_file(path, origin.input_fingerprint, read_features, communicator_, messages_)) {
    say(joined("features of ", name, ": reused ", path.filename().string()));
    return std::move(*features);
  }
  Features features = extract_features(source.backbone, dataset_, origin, messages_, communicator_);
  if (communicator_.is_root()) write_features(path, features);
  return features;
}

}  // namespace svnet
