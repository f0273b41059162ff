#pragma once
#include <vector>

#include "io/models/model_file.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Returns the score that SV-net predicts for every view of the dataset, from the features of the top views.
std::vector<double> predicted_scores(const Run& run, FeaturesStage& features, const Model& model);

}  // namespace svnet::train
