#include "train/stages/features.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/text.h"
#include "io/files/snapshot_path.h"
#include "train/calibration.h"
#include "train/stages/reuse_or_make.h"
#include "train/top_frames.h"
#include "train/turned_features.h"
#include "train/turned_projection.h"
#include "train/view_shapes.h"

namespace svnet::train {
namespace {

/// Of the file of features.
std::string file_stem(const std::string& backbone, const std::string& layer) {
  return "features-" + backbone + (layer.empty() ? "" : "-" + layer);
}

}  // namespace

std::filesystem::path features_file(const std::filesystem::path& folder, const std::string& backbone,
                                    const std::string& layer) {
  return folder / (file_stem(backbone, layer) + ".h5");
}

std::filesystem::path turned_features_file(const std::filesystem::path& folder, const std::string& backbone,
                                           const std::string& layer) {
  return folder / (file_stem(backbone, layer) + "-turned.h5");
}

const BackboneWithOrigin& FeaturesStage::backbone(const std::string& name, const std::string& layer) {
  const std::string key = name + "/" + layer;
  const auto found = backbones_.find(key);
  if (found != backbones_.end()) return found->second;
  const auto& folder = run_.config.weights.folder;
  if (run_.inference.precision != runtime::Precision::int8)
    return backbones_.emplace(key, backbone_from_folder(name, layer, folder, run_.seed(), run_.inference))
        .first->second;
  const BackboneWithOrigin exact = backbone_from_folder(name, layer, folder, run_.seed());
  return backbones_.emplace(key, calibrated(exact, run_.dataset, kCalibrationImages, run_.messages)).first->second;
}

std::string FeaturesStage::fingerprint(const std::string& name, const std::string& layer) {
  return features_origin(backbone(name, layer), run_.dataset_fingerprint).input_fingerprint;
}

const Features& FeaturesStage::stored(const std::filesystem::path& path, const FeaturesOrigin& origin,
                                      const std::string& content, const std::function<Features()>& make) {
  const auto found = features_.find(path);
  if (found != features_.end()) return found->second;
  const StageFile file{.path = path, .fingerprint = origin.input_fingerprint, .content = content};
  return features_.emplace(path, reuse_or_make(run_, file, io::read_features, make, write_made_features)).first->second;
}

const Features& FeaturesStage::features(const std::string& name, const std::string& layer) {
  const BackboneWithOrigin& source = backbone(name, layer);
  const FeaturesOrigin origin = features_origin(source, run_.dataset_fingerprint);
  const std::filesystem::path file = features_file(run_.folder, name, layer);
  return stored(file, origin, "features of " + name, [&] {
    return extract_features(source.backbone, run_.dataset, origin, run_.messages, run_.communicator,
                            io::snapshot_path(file));
  });
}

const Features& FeaturesStage::turned_features(const std::string& name, const std::string& layer) {
  const BackboneWithOrigin& source = backbone(name, layer);
  const FeaturesOrigin origin = turned_features_origin(source, run_.dataset_fingerprint);
  return stored(turned_features_file(run_.folder, name, layer), origin, "turned features of " + name, [&] {
    return extract_turned_features(source.backbone, run_.dataset, origin, run_.messages, run_.communicator);
  });
}

std::string FeaturesStage::turned_fingerprint(const std::string& name, const std::string& layer) {
  return joined(turned_features_origin(backbone(name, layer), run_.dataset_fingerprint).input_fingerprint, " 1 ",
                kTurnedComponents);  // "1": how components are found
}

const PrincipalComponents& FeaturesStage::turned_components(const std::string& name, const std::string& layer,
                                                            const std::vector<bool>& categories) {
  if (components_ && components_->backbone == name && components_->layer == layer &&
      components_->categories == categories)
    return components_->components;
  const Features& turned = turned_features(name, layer);
  components_ = {name, layer, categories,
                 train::turned_components(run_.dataset, turned, categories, run_.seed(), Parallel::shared())};
  return components_->components;
}

std::vector<frame::ViewShape> FeaturesStage::view_shapes() {
  const FeaturesOrigin origin = view_shapes_origin(run_.dataset_fingerprint);
  const Features& stored_shapes = stored(run_.folder / "view-shapes.h5", origin, "shapes of views", [&] {
    return extract_view_shapes(run_.dataset, origin, run_.messages, Parallel::shared());
  });
  std::vector<frame::ViewShape> shapes(static_cast<std::size_t>(stored_shapes.count));
  for (std::size_t v = 0; v < shapes.size(); ++v)
    std::copy_n(stored_shapes.values.begin() + static_cast<std::ptrdiff_t>(v * frame::kViewShapeSize),
                frame::kViewShapeSize, shapes[v].begin());
  return shapes;
}

const std::vector<frame::TopFrame>& FeaturesStage::frames(frame::DepthChoice depth) {
  const auto found = frames_.find(depth);
  if (found != frames_.end()) return found->second;
  return frames_.emplace(depth, top_frames(run_.dataset, depth, run_.messages, Parallel::shared())).first->second;
}

}  // namespace svnet::train
