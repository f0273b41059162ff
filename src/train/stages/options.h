#pragma once
#include <string>

#include "semantics/semantic_scores.h"
#include "train/config/config.h"
#include "train/trainer.h"

namespace svnet::train {

// From a configuration to the options of the stages.

/// How problems are drawn, in the words of scores files: views uniformly or on-policy.
std::string sampler_text(const Config::Scores& config, bool on_policy = false);

/// From `config.scores` and `config.seed`. `dimension`: of the features.
semantics::ScoreOptions score_options(const Config& config, Index dimension);

/// The number of orientations of the top image over which a score is averaged.
int scored_orientations(const Config& config);
/// The number of orientations of each top image that SV-net is trained on.
int trained_orientations(const Config& config);
/// All but the schedule, which learning_rate_schedule makes.
TrainerOptions trainer_options(const Config& config, const std::string& fingerprint);
Schedule learning_rate_schedule(const Config& config, Index steps_per_epoch);

}  // namespace svnet::train
