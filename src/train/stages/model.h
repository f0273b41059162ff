#pragma once
#include "data/scores.h"
#include "io/models/model_file.h"
#include "train/run.h"
#include "train/stages/features.h"
#include "train/stages/resume.h"

namespace svnet::train {

/// The third stage: trains SV-net, in checkpoint-*.safetensors, metrics.csv and model.safetensors. `resume` says what
/// to do with the model and the checkpoints of an earlier run.
Model model_stage(const Run& run, FeaturesStage& features, const Scores& scores, Resume resume = Resume::same);

/// Whether the run folder holds the model that this configuration leads to.
bool model_is_current(const Run& run, FeaturesStage& features);

/// The model in the run folder. Throws Error if there is none, or if it was trained with another configuration.
Model trained_model(const Run& run, FeaturesStage& features);

}  // namespace svnet::train
