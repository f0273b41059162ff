#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "frame/top_frame.h"
#include "io/views/features_file.h"
#include "train/feature_extraction.h"
#include "train/run.h"

namespace svnet::train {

/// The first stage: features of every view, in features-<backbone>[-<layer>].h5. Features, and the weights of a
/// backbone, are read or made once, when a later stage first asks for them. The layer "" is the pooled output.
/// References that are returned live as long as this object. Keeps a reference to the run. Not thread-safe.
class FeaturesStage {
 public:
  explicit FeaturesStage(const Run& run) : run_(run) {}

  const Features& features(const std::string& backbone, const std::string& layer);
  const BackboneWithOrigin& backbone(const std::string& name, const std::string& layer);
  /// The fingerprint that features() have. Loads the backbone, but not the features.
  std::string fingerprint(const std::string& backbone, const std::string& layer);
  /// What is measured on every pose's top view (train/top_frames.h), of the images alone or with their depth.
  const std::vector<frame::TopFrame>& frames(frame::DepthChoice depth);

 private:
  const Run& run_;
  std::map<std::string, BackboneWithOrigin> backbones_{};
  std::map<std::filesystem::path, Features> features_{};  // by their file
  std::map<frame::DepthChoice, std::vector<frame::TopFrame>> frames_{};
};

}  // namespace svnet::train
