#pragma once
#include <span>
#include <string>

#include "semantics/clustering_problems.h"
#include "train/config/config.h"
#include "train/config/stage.h"

// The fingerprint of a stage is the SHA-256 of the fingerprints of its inputs and of the names and values of the keys
// that the table of keys (config_table.cpp) gives to the stage. A result whose file has the fingerprint that is wanted
// need not be made again. Keys of earlier stages count through the inputs.
//
// The keys of Stage::features name the images, the weights and the layer that features are made of. The fingerprint
// of features (features_origin in feature_extraction.h) covers what these contain, so that moving a folder changes
// nothing. Hence the text of these keys is part of no fingerprint.
//
// On-policy scores (scores.rounds) are made with weights of views, which a model of other scores predicts. The files of
// these scores have the fingerprint of the weights themselves. What is made from them later has the fingerprint of the
// keys and inputs that lead to the weights, which is known before any weights are.

namespace svnet::train {

/// Changes with everything that the scores of these features depend on.
std::string scores_fingerprint(const std::string& features_fingerprint, const Config& config);

/// The same for scores whose views are drawn by weights, down to the last bit of the weights.
std::string scores_fingerprint(const std::string& features_fingerprint, const semantics::ViewWeights& weights,
                               const Config& config);

/// The fingerprint of the mean of scores that have these fingerprints.
std::string mean_scores_fingerprint(std::span<const std::string> scores, const Config& config);

/// Changes with everything that the model depends on. `features` is the fingerprint of the features that SV-net learns
/// from, `scores` that of the scores.
std::string model_fingerprint(const std::string& features, const std::string& scores, const Config& config);

/// The fingerprint of any stage after the features. `inputs` are the fingerprints of its inputs, in a fixed order.
std::string stage_fingerprint(Stage stage, std::span<const std::string> inputs, const Config& config);

}  // namespace svnet::train
