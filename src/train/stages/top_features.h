#pragma once
#include <vector>

#include "data/model.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// What predict::Predictor::embed returns for the top view of every pose of the dataset, (poses, D), if the model is in
/// a frame other than `camera`; made of what the first stage has. The head of the model need not be there.
std::vector<float> top_features(const Run& run, FeaturesStage& features, const Model& model);

}  // namespace svnet::train
