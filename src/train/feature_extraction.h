#pragma once
#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "models/backbone.h"

namespace svnet {

/// Features of every view of the dataset, in its order. While a batch runs through the backbone, the pictures of the
/// next one are read and prepared by threads of their own (with one thread in all: one after the other). The same bits
/// for any number of threads, and whatever pictures share a batch. `origin` is copied into the result. A communicator
/// shares the batches; each of its processes gets all features.
Features extract_features(const Backbone& backbone, const ViewDataset& dataset, const FeaturesOrigin& origin,
                          const Messages& messages, Communicator& communicator);

/// "tf 224x224 bilinear": what FeaturesOrigin::preprocessing says.
std::string preprocessing_text(const Preprocessing& preprocessing);

/// The backbone with the weights that `folder` holds for it, else those that are built in, else, where the folder is
/// empty, seeded random ones; and a text that identifies the weights: the SHA-256 of their file, or "random, seed 7".
/// Throws Error as check_weights does.
struct BackboneWithOrigin {
  Backbone backbone;
  std::string weights;
};
BackboneWithOrigin backbone_from_folder(const std::string& name, const std::string& layer,
                                        const std::filesystem::path& folder, std::uint64_t seed);

/// Throws Error where a folder is given that holds no weights of the backbone, and none are built in.
void check_weights(const std::string& name, const std::filesystem::path& folder);

/// The fields of the origin that follow from backbone, weights and pictures, the input fingerprint included. Features
/// in bf16 say so beside the preprocessing, and have another fingerprint.
FeaturesOrigin features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint);

}  // namespace svnet
