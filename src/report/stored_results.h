#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "data/view_dataset.h"
#include "report/run_report.h"

// What run folders hold besides features and models. All functions throw Error that names the file if it is missing or
// damaged, and says what to do, unless the result is optional: nothing if there is no such file.
namespace svnet::report {

/// What is known of a view: NaN if it is not.
struct ViewPrediction {
  double predicted = 0;  ///< SV-net's score; in a cross-validation that of models without the view's category
  double score = 0;      ///< the true score: individual or global, as sv_net.target says
  double standard_error = 0;
  bool held_out = false;
};

/// predictions.json: {"format": 1, "views": [[path, held out, predicted, score, standard error], …]}, in the dataset's
/// order; null: not known. Requires an element per view.
void write_predictions(const std::filesystem::path& folder, const ViewDataset& dataset,
                       const std::vector<ViewPrediction>& predictions);
/// Throws Error also if the views are not those of the dataset.
std::vector<ViewPrediction> read_predictions(const std::filesystem::path& folder, const ViewDataset& dataset);

/// The tables of evaluation.json, that of held-out categories first.
std::vector<Table> read_tables(const std::filesystem::path& folder);

/// The folds of crossval.json.
std::vector<FoldFigures> read_folds(const std::filesystem::path& folder);

/// metrics.csv.
std::optional<TrainingCurves> read_curves(const std::filesystem::path& folder);

}  // namespace svnet::report
