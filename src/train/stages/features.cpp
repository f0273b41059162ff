#include "train/stages/features.h"

#include "base/parallel.h"
#include "train/stages/reuse_or_make.h"
#include "train/top_frames.h"

namespace svnet::train {

const BackboneWithOrigin& FeaturesStage::backbone(const std::string& name, const std::string& layer) {
  const std::string key = name + "/" + layer;
  const auto found = backbones_.find(key);
  if (found != backbones_.end()) return found->second;
  return backbones_
      .emplace(key, backbone_from_folder(name, layer, run_.config.weights.folder, run_.seed(), run_.inference))
      .first->second;
}

std::string FeaturesStage::fingerprint(const std::string& name, const std::string& layer) {
  return features_origin(backbone(name, layer), run_.dataset_fingerprint).input_fingerprint;
}

const Features& FeaturesStage::features(const std::string& name, const std::string& layer) {
  const std::filesystem::path path = run_.folder / ("features-" + name + (layer.empty() ? "" : "-" + layer) + ".h5");
  const auto found = features_.find(path);
  if (found != features_.end()) return found->second;
  const BackboneWithOrigin& source = backbone(name, layer);
  const FeaturesOrigin origin = features_origin(source, run_.dataset_fingerprint);
  const auto make = [&] {
    return extract_features(source.backbone, run_.dataset, origin, run_.messages, run_.communicator);
  };
  const StageFile file{.path = path, .fingerprint = origin.input_fingerprint, .content = "features of " + name};
  return features_.emplace(path, reuse_or_make(run_, file, io::read_features, make, io::write_features)).first->second;
}

const std::vector<frame::TopFrame>& FeaturesStage::frames(frame::DepthChoice depth) {
  const auto found = frames_.find(depth);
  if (found != frames_.end()) return found->second;
  return frames_.emplace(depth, top_frames(run_.dataset, depth, run_.messages, Parallel::shared())).first->second;
}

}  // namespace svnet::train
