#pragma once
#include <vector>

#include "io/models/model_file.h"
#include "train/run.h"
#include "train/selectors.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Returns the score that SV-net predicts for every view of the dataset, from the features of the top views.
std::vector<double> predicted_scores(const Run& run, FeaturesStage& features, const Model& model);

/// What the model says of the next view; empty if it does not know. Keeps references to the run.
NextScores next_scores(const Run& run, FeaturesStage& features, const Model& model);

}  // namespace svnet::train
