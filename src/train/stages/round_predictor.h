#pragma once
#include <functional>
#include <vector>

#include "data/scores.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Returns the score of every view of the dataset as a model predicts it that is trained on the given scores. Called
/// once for each round, from the uniform scores on, in every process of the communicator. A function of the scores and
/// of what the fingerprint of the model covers.
using RoundPredictor = std::function<std::vector<double>(const Scores&)>;

/// Trains SV-net as the configuration says, in the folder round-<n> of the run folder, where it resumes and is reused.
/// Keeps references to both arguments.
RoundPredictor sv_net_round_predictor(const Run& run, FeaturesStage& features);

}  // namespace svnet::train
