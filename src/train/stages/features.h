#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frame/next_inputs.h"
#include "frame/top_frame.h"
#include "io/views/features_file.h"
#include "train/feature_extraction.h"
#include "train/principal_components.h"
#include "train/run.h"

namespace svnet::train {

/// The files of features of every view, and of every turn of the top views, in a run folder. The layer "" is the pooled
/// output.
std::filesystem::path features_file(const std::filesystem::path& folder, const std::string& backbone,
                                    const std::string& layer);
std::filesystem::path turned_features_file(const std::filesystem::path& folder, const std::string& backbone,
                                           const std::string& layer);

/// The first stage: features of every view, in features-<backbone>[-<layer>].h5, and of every turn of the top views, in
/// features-<backbone>[-<layer>]-turned.h5. Features, and the weights of a
/// backbone, are read or made once, when a later stage first asks for them. The layer "" is the pooled output.
/// References that are returned live as long as this object. Keeps a reference to the run. Not thread-safe.
class FeaturesStage {
 public:
  explicit FeaturesStage(const Run& run) : run_(run) {}

  const Features& features(const std::string& backbone, const std::string& layer);
  const BackboneWithOrigin& backbone(const std::string& name, const std::string& layer);
  /// The fingerprint that features() have. Loads the backbone, but not the features.
  std::string fingerprint(const std::string& backbone, const std::string& layer);
  /// Features of every turn of the top views (train/turned_features.h).
  const Features& turned_features(const std::string& backbone, const std::string& layer);
  /// The fingerprint of turned_features() and of their components. Loads the backbone, but not the features.
  std::string turned_fingerprint(const std::string& backbone, const std::string& layer);
  /// The components of turned_features() over these categories (train/turned_projection.h). Those of the last call are
  /// kept: the rounds of a fold share them.
  const PrincipalComponents& turned_components(const std::string& backbone, const std::string& layer,
                                               const std::vector<bool>& categories);
  /// What is measured on every pose's top view (train/top_frames.h), of the images alone or with their depth.
  const std::vector<frame::TopFrame>& frames(frame::DepthChoice depth);
  /// What the picture of every view shows of the object's shape (frame/next_inputs.h), in view-shapes.h5.
  std::vector<frame::ViewShape> view_shapes();

 private:
  struct Components {
    std::string backbone, layer;
    std::vector<bool> categories;
    PrincipalComponents components{};
  };
  const Features& stored(const std::filesystem::path& path, const FeaturesOrigin& origin, const std::string& content,
                         const std::function<Features()>& make);

  const Run& run_;
  std::map<std::string, BackboneWithOrigin> backbones_{};
  std::map<std::filesystem::path, Features> features_{};  // by their file
  std::optional<Components> components_{};
  std::map<frame::DepthChoice, std::vector<frame::TopFrame>> frames_{};
};

}  // namespace svnet::train
