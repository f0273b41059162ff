#pragma once
#include "semantics/semantic_scores.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet {

/// Semantic scores of the views of the held-out categories, in `problems` problems of these categories alone.
SemanticScores held_out_scores(const Run& run, FeaturesStage& features, std::uint64_t problems);

}  // namespace svnet
