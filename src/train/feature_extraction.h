#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "models/backbone.h"
#include "train/extraction.h"

namespace svnet::train {

/// Returns the features of every view of the dataset, in its order, with `origin` copied into them. The threads decode
/// images and run the backbone as train/extraction.h says. The processes of the communicator share the images, and each
/// gets all features. The bits do not depend on the number of threads and processes, or on the images that share a
/// batch.
///
/// With `snapshot`, a single process keeps the views so far in this file, as features of the first views, about once a
/// minute, and if messages.progress throws. It goes on from the file if it is of the same origin and views.
Features extract_features(const models::Backbone& backbone, const ViewDataset& dataset, const FeaturesOrigin& origin,
                          const Messages& messages, Communicator& communicator,
                          const std::filesystem::path& snapshot = {});

/// Writes the features to `path` and removes the snapshot beside it (io/files/snapshot_path.h).
void write_made_features(const std::filesystem::path& path, const Features& features);

/// The views [begin, end) of a dataset as a batch (N, H, W, 3).
Tensor prepared_views(const models::Preprocessing& how, const ViewDataset& dataset, Index begin, Index end,
                      Parallel& parallel);

/// "tf 224x224 bilinear": what FeaturesOrigin::preprocessing says.
std::string preprocessing_text(const models::Preprocessing& preprocessing);

/// A backbone, and where its weights come from.
struct BackboneWithOrigin {
  models::Backbone backbone;
  std::string weights;  ///< the SHA-256 of their file, or "random, seed 7"
};

/// The backbone with the weights that `folder` holds for it; otherwise those that are built in; otherwise, if `folder`
/// is empty, random ones. Throws Error as check_weights does.
BackboneWithOrigin backbone_from_folder(const std::string& name, const std::string& layer,
                                        const std::filesystem::path& folder, std::uint64_t seed,
                                        const InferenceOptions& options = {});

/// Throws Error if `folder` is given but holds no weights of the backbone, and none are built in.
void check_weights(const std::string& name, const std::filesystem::path& folder);

/// The origin of the features of a backbone and of images. If products are in bf16 or int8, the preprocessing says so,
/// with the fingerprint of the ranges of int8, and the fingerprint is another.
FeaturesOrigin features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint);

}  // namespace svnet::train
