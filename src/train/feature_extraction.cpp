#include "train/feature_extraction.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/sha256.h"
#include "io/file_hash.h"
#include "io/image_file.h"
#include "io/keras_graph.h"

namespace svnet {
namespace {

constexpr Index kBatch = 16;

}  // namespace

std::string preprocessing_text(const Preprocessing& p) {
  return joined(name_of(p.mode), " ", p.height, "x", p.width, " ", name_of(p.interpolation));
}

BackboneWithOrigin backbone_from_folder(const std::string& name, const std::string& layer,
                                        const std::filesystem::path& folder, std::uint64_t seed) {
  if (folder.empty()) return {random_backbone(name, layer, seed), joined("random, seed ", seed)};
  const auto file = find_weights(backbone_kind(name), folder);
  return {read_backbone(name, file, layer), file_sha256(file)};
}

FeaturesOrigin features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint) {
  FeaturesOrigin origin{.backbone = from.backbone.kind().name,
                        .output = from.backbone.output_name(),
                        .preprocessing = preprocessing_text(from.backbone.preprocessing()),
                        .weights_sha256 = from.weights,
                        .dataset_fingerprint = dataset_fingerprint,
                        .input_fingerprint = {}};
  Sha256 hash;
  for (const auto& field : {std::string("features 1"), origin.backbone, origin.output, origin.preprocessing,
                            origin.weights_sha256, origin.dataset_fingerprint})
    hash.update_field(field);
  origin.input_fingerprint = hash.hex();
  return origin;
}

Features extract_features(const Backbone& backbone, const ViewDataset& dataset, const FeaturesOrigin& origin,
                          const Messages& messages, Team& team) {
  const auto count = static_cast<Index>(dataset.views.size());
  const Index dimension = backbone.dimension(), pixels = backbone.preprocessing().size();
  Features features{origin, count, dimension, {}, {}, {}};
  features.values.resize(static_cast<std::size_t>(count * dimension));
  for (const View& view : dataset.views) {
    features.theta_phi_deg.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    features.paths.push_back(view.path);
  }
  // Shares are whole batches, so that the batches are the same for any number of processes.
  const Share share = share_of(team, 0, static_cast<std::uint64_t>((count + kBatch - 1) / kBatch));
  const Index first = static_cast<Index>(share.first) * kBatch;
  const Index last = std::min(count, static_cast<Index>(share.last) * kBatch);
  Progress progress(messages, "features of " + backbone.kind().name, std::max<Index>(last - first, 0));
  for (Index begin = first; begin < last; begin += kBatch) {
    const Index size = std::min(kBatch, count - begin);
    Tensor batch = Tensor::empty({size, backbone.preprocessing().height, backbone.preprocessing().width, 3});
    Parallel::shared().for_chunks(size, 1, [&](Index i, Index, int) {
      const View& view = dataset.views[static_cast<std::size_t>(begin + i)];
      prepare(backbone.preprocessing(), read_image(dataset.root / view.path), batch.data<float>() + i * pixels);
    });
    const Tensor values = backbone.features(batch);
    for (Index i = 0; i < values.size(); ++i)
      check(std::isfinite(values.data<float>()[i]), "[", backbone.kind().name, "] a feature of ",
            dataset.views[static_cast<std::size_t>(begin + i / dimension)].path,
            " is not finite: the weights do not fit this network");
    std::copy_n(values.data<float>(), values.size(), features.values.data() + begin * dimension);
    progress.update(begin + size - first);
  }
  team.gather(features.values);
  return features;
}

}  // namespace svnet
