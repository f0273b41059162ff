#pragma once
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "data/features.h"
#include "data/model.h"
#include "data/view_dataset.h"
#include "models/backbone.h"
#include "nn/runtime/inference_options.h"
#include "train/principal_components.h"

namespace svnet::train {

/// The most components that a head in a frame with turns sees of each turn.
inline constexpr Index kTurnedComponents = 150;

/// The principal components of turned features (train/turned_features.h) as a head sees them at the azimuth of every
/// turn, over the poses of `categories`.
PrincipalComponents turned_components(const ViewDataset& dataset, const Features& turned,
                                      const std::vector<bool>& categories, std::uint64_t seed, Parallel& parallel);

/// Gives the model the backbone, pooled and projected to the components.
void set_turned_backbone(Model& model, const models::Backbone& backbone, const PrincipalComponents& components);

/// The values of all turns as the model's projection makes them of turned features: (poses, kTurns · components).
/// Throws Error if the features are not those that the projection takes.
std::vector<float> projected_turns(const Model& model, const Features& turned, const InferenceOptions& inference);

}  // namespace svnet::train
