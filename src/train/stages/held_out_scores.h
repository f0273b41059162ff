#pragma once
#include "semantics/semantic_scores.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Semantic scores of the views of the held-out categories, in `problems` problems of these categories alone, whose
/// views are uniform. The mean over the backbones of the scores.
semantics::SemanticScores held_out_scores(const Run& run, FeaturesStage& features, std::uint64_t problems);

}  // namespace svnet::train
