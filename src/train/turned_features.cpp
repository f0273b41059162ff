#include "train/turned_features.h"

#include "base/error.h"
#include "base/sha256.h"
#include "base/text.h"
#include "frame/turns.h"
#include "io/images/image_file.h"
#include "io/views/composed_name.h"
#include "models/turned_backbone.h"

namespace svnet::train {
namespace {

const std::string& top_path(const ViewDataset& dataset, Index pose) {
  return dataset.views[static_cast<std::size_t>(dataset.top_view(pose))].path;
}

/// The rows [begin, end) as images; whole poses.
Tensor prepared_turns(const models::Preprocessing& how, const ViewDataset& dataset, Index begin, Index end,
                      Parallel& parallel) {
  Tensor batch = Tensor::empty({end - begin, how.height, how.width, 3});
  parallel.for_chunks((end - begin) / frame::kTurns, 1, [&](Index i, Index, int) {
    const auto path = dataset.root / top_path(dataset, begin / frame::kTurns + i);
    const auto images = frame::turned_images(io::read_image(path, dataset.exif_orientation), how.height);
    float* to = batch.data<float>() + i * frame::kTurns * how.size();
    for (const Image& image : images) {
      prepare(how, image, to);
      to += how.size();
    }
  });
  return batch;
}

}  // namespace

Features extract_turned_features(const models::Backbone& backbone, const ViewDataset& dataset,
                                 const FeaturesOrigin& origin, const Messages& messages, Communicator& communicator) {
  const models::Preprocessing& how = backbone.preprocessing();
  check(how.height == how.width, "[turned] images of ", how.height, "x", how.width,
        " cannot be turned; only square ones can");
  const Graph graph = models::pooled_graph(backbone.graph());
  const Inference network(graph, backbone.parameters(), graph.output(), backbone.network().options());
  const auto poses = static_cast<Index>(dataset.poses.size());
  Features features{origin, poses * frame::kTurns, element_count(network.output_shape()), {}, {}, {}};
  for (Index pose = 0; pose < poses; ++pose)
    for (const frame::Turn& turn : frame::turns()) {
      features.theta_phi_deg.push_back({turn.theta_deg, 90});
      features.paths.push_back(top_path(dataset, pose));
    }
  features.values =
      extracted({.network = backbone.kind().name + ", turned",
                 .count = features.count,
                 .dimension = features.dimension,
                 .batch = 2 * frame::kTurns,
                 .unit = frame::kTurns,
                 .memory = [&](Index rows) { return network.arena_size(rows); },
                 .prepared = [&](Index begin, Index end,
                                 Parallel& parallel) { return prepared_turns(how, dataset, begin, end, parallel); },
                 .run = [&](const Tensor& batch) { return network.run({batch}); },
                 .name = [&](Index row) { return features.paths[static_cast<std::size_t>(row)]; }},
                messages, communicator);
  return features;
}

FeaturesOrigin turned_features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint) {
  FeaturesOrigin origin = features_origin(from, dataset_fingerprint);
  origin.output += ", 3x3 places";
  origin.preprocessing += joined(", ", frame::kTurns, " turns");
  Sha256 hash;
  hash.update_field("turned features 1").update_field(origin.input_fingerprint);
  for (const frame::Turn& turn : frame::turns())
    hash.update_field(joined(turn.theta_deg, turn.is_mirrored ? " mirrored" : ""));
  origin.input_fingerprint = hash.hex();
  return origin;
}

void check_turned_rows(const ViewDataset& dataset, const Features& features) {
  const std::size_t rows = dataset.poses.size() * frame::kTurns;
  check(features.paths.size() == rows, "turned features of ", features.paths.size(), " images do not belong to a ",
        "dataset of ", dataset.poses.size(), " poses in ", frame::kTurns, " turns");
  for (std::size_t row = 0; row < rows; ++row) {
    const std::string& path = top_path(dataset, static_cast<Index>(row / frame::kTurns));
    check(io::composed_name(features.paths[row]) == io::composed_name(path), "turned features: row ", row, " is ",
          features.paths[row], ", the dataset has ", path);
  }
}

}  // namespace svnet::train
