#include "train/feature_extraction.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/sha256.h"
#include "base/text.h"
#include "io/files/file_hash.h"
#include "io/files/snapshot_path.h"
#include "io/images/image_file.h"
#include "io/models/backbone_file.h"
#include "io/views/features_file.h"

namespace svnet::train {
using models::BackboneKind;
using models::Preprocessing;

Tensor prepared_views(const Preprocessing& how, const ViewDataset& dataset, Index begin, Index end,
                      Parallel& parallel) {
  Tensor batch = Tensor::empty({end - begin, how.height, how.width, 3});
  parallel.for_chunks(end - begin, 1, [&](Index i, Index, int) {
    const View& view = dataset.views[static_cast<std::size_t>(begin + i)];
    prepare(how, io::read_image(dataset.root / view.path, dataset.exif_orientation),
            batch.data<float>() + i * how.size());
  });
  return batch;
}

std::string preprocessing_text(const Preprocessing& p) {
  return joined(name_of(p.mode), " ", p.height, "x", p.width, " ", name_of(p.interpolation));
}

BackboneWithOrigin backbone_from_folder(const std::string& name, const std::string& layer,
                                        const std::filesystem::path& folder, std::uint64_t seed,
                                        const InferenceOptions& options) {
  const BackboneKind& kind = models::backbone_kind(name);
  if (!folder.empty())
    if (const auto file = io::find_weights(kind, folder))
      return {io::read_backbone(name, *file, layer, nullptr, options), io::file_sha256(*file)};
  if (auto built_in = io::built_in_backbone(name, layer, options))
    return {std::move(built_in->backbone), built_in->sha256};
  check_weights(name, folder);
  return {models::random_backbone(name, layer, seed, options), joined("random, seed ", seed)};
}

void check_weights(const std::string& name, const std::filesystem::path& folder) {
  const BackboneKind& kind = models::backbone_kind(name);
  check(folder.empty() || io::find_weights(kind, folder) || io::has_built_in_weights(kind), folder.string(),
        ": no weights of ", kind.name, "; put one of these files there: ", kind.name, ".safetensors, ",
        joined_with(", ", kind.weight_files));
}

namespace {

/// ", products in bf16"; "" for f32. In int8 features depend on the ranges too.
std::string precision_text(const Inference& network) {
  switch (network.options().precision) {
    case runtime::Precision::f32:
      break;
    case runtime::Precision::bf16:
      return ", products in bf16";
    case runtime::Precision::int8:
      return ", products in int8, ranges " + fingerprint(*network.options().ranges).substr(0, 16);
  }
  return "";
}

}  // namespace

FeaturesOrigin features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint) {
  FeaturesOrigin origin{
      .backbone = from.backbone.kind().name,
      .output = from.backbone.output_name(),
      .preprocessing = preprocessing_text(from.backbone.preprocessing()) + precision_text(from.backbone.network()),
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

namespace {

/// The values of the first views in a snapshot; none if it is not of these features.
std::vector<float> values_in(const std::filesystem::path& snapshot, const Features& features,
                             const Messages& messages) {
  if (snapshot.empty() || !std::filesystem::exists(snapshot)) return {};
  try {
    Features kept = io::read_features(snapshot);
    const bool fits = kept.input_fingerprint == features.input_fingerprint && kept.dimension == features.dimension &&
                      kept.count <= features.count &&
                      std::equal(kept.paths.begin(), kept.paths.end(), features.paths.begin());
    if (!fits) return {};
    if (messages.line) messages.line(joined("features of ", features.backbone, ": go on after ", kept.count, " views"));
    return std::move(kept.values);
  } catch (const Error& error) {
    if (messages.line) messages.line(joined("made again: ", error.what()));
    return {};
  }
}

/// Writes the values of the first views.
void write_snapshot(const std::filesystem::path& snapshot, const Features& features, std::span<const float> values) {
  const auto count = static_cast<std::ptrdiff_t>(values.size()) / features.dimension;
  io::write_features(snapshot, {features,
                                count,
                                features.dimension,
                                {values.begin(), values.end()},
                                {features.theta_phi_deg.begin(), features.theta_phi_deg.begin() + count},
                                {features.paths.begin(), features.paths.begin() + count}});
}

}  // namespace

Features extract_features(const models::Backbone& backbone, const ViewDataset& dataset, const FeaturesOrigin& origin,
                          const Messages& messages, Communicator& communicator, const std::filesystem::path& snapshot) {
  constexpr Index kBatch = 16;
  const bool keeps = !snapshot.empty() && communicator.size() == 1;
  Features features{origin, static_cast<Index>(dataset.views.size()), backbone.dimension(), {}, {}, {}};
  for (const View& view : dataset.views) {
    features.theta_phi_deg.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    features.paths.push_back(view.path);
  }
  const std::function<void(std::span<const float>)> keep = [&](std::span<const float> values) {
    write_snapshot(snapshot, features, values);
  };
  features.values = extracted({.network = backbone.kind().name,
                               .count = features.count,
                               .dimension = features.dimension,
                               .batch = kBatch,
                               .memory = [&](Index views) { return backbone.network().arena_size(views); },
                               .prepared =
                                   [&](Index begin, Index end, Parallel& parallel) {
                                     return prepared_views(backbone.preprocessing(), dataset, begin, end, parallel);
                                   },
                               .run = [&](const Tensor& batch) { return backbone.features(batch); },
                               .name = [&](Index view) { return features.paths[static_cast<std::size_t>(view)]; },
                               .made = keeps ? values_in(snapshot, features, messages) : std::vector<float>(),
                               .keep = keeps ? keep : nullptr},
                              messages, communicator);
  return features;
}

void write_made_features(const std::filesystem::path& path, const Features& features) {
  io::write_features(path, features);
  std::error_code no_snapshot;
  std::filesystem::remove(io::snapshot_path(path), no_snapshot);
}

}  // namespace svnet::train
