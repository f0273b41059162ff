#pragma once
#include <filesystem>
#include <optional>
#include <span>

#include "data/scores.h"
#include "semantics/score_sums.h"
#include "train/evaluation_text.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// What the last stage takes from the earlier ones.
struct EvaluationInputs {
  FeaturesStage& features;
  const Scores& scores;               ///< of the training categories
  std::span<const double> predicted;  ///< SV-net's score of every view
  /// Of the held-out categories (held_out_scores.h), if they are at hand; otherwise they are made when they are needed.
  const semantics::SemanticScores* held_out = nullptr;
  NextScores next{};  ///< predictions.h
};

/// The last stage: how well views that selectors choose are clustered. Returns the tables of training categories and,
/// if there are at least 2, of held-out categories. Writes evaluation.json, also to `copy` if it is given.
EvaluationTables evaluation_stage(const Run& run, const EvaluationInputs& inputs, std::uint64_t problems,
                                  const std::optional<std::filesystem::path>& copy = {});

}  // namespace svnet::train
