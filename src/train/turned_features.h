#pragma once
#include "base/communicator.h"
#include "base/progress.h"
#include "data/features.h"
#include "data/view_dataset.h"
#include "train/feature_extraction.h"

namespace svnet::train {

/// What a backbone says of the top view of every pose of a dataset in every turn (frame/turns.h): row
/// pose · kTurns + turn is the output of models::pooled_graph. theta_phi_deg is the azimuth of the turn, and 90; the
/// path is that of the top view. The bits depend on what those of extract_features do not depend on.
Features extract_turned_features(const models::Backbone& backbone, const ViewDataset& dataset,
                                 const FeaturesOrigin& origin, const Messages& messages, Communicator& communicator);

/// As features_origin. The fingerprint changes with the turns and the pooling, too.
FeaturesOrigin turned_features_origin(const BackboneWithOrigin& from, const std::string& dataset_fingerprint);

/// Throws Error unless the features are those of the top views of the dataset in every turn.
void check_turned_rows(const ViewDataset& dataset, const Features& features);

}  // namespace svnet::train
