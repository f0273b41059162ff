#pragma once
#include <string>

#include "semantics/semantic_scores.h"
#include "train/config/config.h"
#include "train/trainer.h"

namespace svnet::train {

// The options of the stages as a configuration says them.

/// How problems are drawn, as scores files say it.
std::string sampler_text(const Config::Scores& config);

/// What `config.scores` and `config.seed` say of scores of features of that dimension.
semantics::ScoreOptions score_options(const Config& config, Index dimension);

/// Orientations of the top image whose mean a score is.
int scored_orientations(const Config& config);
/// Orientations of each top image that SV-net is trained on.
int trained_orientations(const Config& config);
/// The schedule stays empty; see learning_rate_schedule.
TrainerOptions trainer_options(const Config& config, const std::string& fingerprint);
Schedule learning_rate_schedule(const Config& config, Index steps_per_epoch);

}  // namespace svnet::train
