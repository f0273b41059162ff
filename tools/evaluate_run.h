#pragma once
#include <filesystem>
#include <optional>

#include "command/console.h"
#include "data/model.h"
#include "data/scores.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::command {

struct EvaluationOutput {
  std::optional<std::filesystem::path> json{};  ///< a copy of evaluation.json
  bool prints = true;                           ///< the tables
  bool open = false;                            ///< shows report.html in a browser
};

/// What svnet-eval does with a trained run: prints the tables, and writes evaluation.json, predictions.json, views.png,
/// the events of the evaluation and report.html into the run folder.
void evaluate_run(const train::Run& run, train::FeaturesStage& features, const Model& model, const Scores& scores,
                  const EvaluationOutput& output, Console& console);

}  // namespace svnet::command
