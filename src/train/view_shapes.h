#pragma once
#include "base/parallel.h"
#include "base/progress.h"
#include "data/features.h"
#include "data/view_dataset.h"

namespace svnet::train {

/// What the picture of every view shows of the object's shape (frame/next_inputs.h), as features: a row per view.
/// Throws Error that names an image that cannot be read.
Features extract_view_shapes(const ViewDataset& dataset, const FeaturesOrigin& origin, const Messages& messages,
                             Parallel& parallel);

/// The origin of these features.
FeaturesOrigin view_shapes_origin(const std::string& dataset_fingerprint);

}  // namespace svnet::train
