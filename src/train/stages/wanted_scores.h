#pragma once
#include <string>

#include "train/config/config.h"
#include "train/stages/features.h"

namespace svnet::train {

/// The fingerprint of the scores that SV-net is trained on, as the configuration says them; none need to be made yet.
/// See fingerprint.h for how the files of on-policy scores differ.
std::string wanted_scores_fingerprint(const Config& config, FeaturesStage& features);

}  // namespace svnet::train
