#pragma once
#include <filesystem>

#include "base/parallel.h"
#include "base/progress.h"
#include "report/run_report.h"
#include "report/stored_results.h"
#include "semantics/score_sums.h"
#include "train/run.h"
#include "train/stages/cross_validation.h"

namespace svnet::report {

/// What the page shows of each view of a run: predicted scores; true scores of training categories, and, if there are
/// problems of held-out categories, theirs (train/stages/held_out_scores.h).
std::vector<ViewPrediction> predictions_of(const train::Run& run, std::span<const double> predicted,
                                           const Scores& scores, const semantics::SemanticScores* held_out);
/// The same of a cross-validation.
std::vector<ViewPrediction> predictions_of(const train::Run& run, const train::CrossValidation& validation);

/// Everything that the page of a run folder shows, from the files in it and the dataset's images. Throws Error that
/// names a file that is missing or damaged, and says what to do.
RunReport collect(const train::Config& config, const ViewDataset& dataset, const std::filesystem::path& folder,
                  Parallel& parallel);

/// Writes report.html into the run folder, or to `file` if it is given. Returns its path. Throws Error as collect does.
std::filesystem::path write_report(const train::Config& config, const ViewDataset& dataset,
                                   const std::filesystem::path& folder, Parallel& parallel,
                                   const std::filesystem::path& file = {});

/// The settings that matter most, in words.
std::vector<Setting> settings_of(const train::Config& config, const ViewDataset& dataset);

}  // namespace svnet::report
