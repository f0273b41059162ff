#pragma once
#include "data/model.h"
#include "train/evaluation.h"
#include "train/run.h"

namespace svnet::train {

/// Puts what the run's model reached on held-out categories into model.safetensors, which is written again if it holds
/// other results. Its input fingerprint stays, so the stage that made it is reused.
void keep_held_out_results(const Run& run, Model model, const EvaluationTable& held_out);

}  // namespace svnet::train
