#pragma once
#include <optional>
#include <string>
#include <vector>

#include "data/scores.h"
#include "train/evaluation.h"
#include "train/run.h"
#include "train/stages/features.h"
#include "train/stages/gain_check.h"
#include "train/within_pose.h"

namespace svnet::train {

/// The names of the categories that are held out together.
using Fold = std::vector<std::string>;

/// Splits the dataset's categories, in random order, into `count` folds of about equal size. Throws Error unless each
/// fold leaves at least 2 categories to train on, and there are at least 2 folds.
std::vector<Fold> drawn_folds(const ViewDataset& dataset, Index count, std::uint64_t seed);

/// The folds `given`, and one more fold of the categories that they do not name, if there are any. Throws Error for an
/// unknown category, or one that is named twice.
std::vector<Fold> completed_folds(const ViewDataset& dataset, std::vector<Fold> given);

/// Every choice of `size` of the dataset's categories, in their order. Throws Error unless each leaves at least 2
/// categories to train on, there are at least 2 in each, and there are at most kMostFolds.
std::vector<Fold> each_choice_of(const ViewDataset& dataset, Index size);
inline constexpr std::size_t kMostFolds = 2000;

/// Which problems the choices of views are judged by.
enum class FoldProblems {
  all_categories,  ///< of all categories, with the choices of all folds at once; each category is in one fold
  own_categories,  ///< of each fold's own categories
};

struct FoldResult {
  Fold held_out;
  WithinPose within_pose;  ///< of the fold's categories
};

struct CrossValidation {
  EvaluationTable table;   ///< with the views that were chosen without their category
  WithinPose within_pose;  ///< over the held-out poses of all folds
  std::vector<FoldResult> folds;
  std::vector<CheckedGain> gains;  ///< of held-out poses; empty if the models do not say
  std::vector<Selector> choices;   ///< the views of the table's selectors; empty with FoldProblems::own_categories
  /// Of every view, the score that the model of its category's fold predicts; the mean over folds if several hold the
  /// category out, NaN if none does.
  std::vector<double> predicted{};
  Scores scores{};  ///< the true scores, of all categories with uniform views
};

/// Writes views.png: the top view of some objects, the view that was chosen for them without their category, and the
/// best one. Returns its path, or nothing if the choices lack one of these.
std::optional<std::filesystem::path> cross_validation_sheet(const Run& run, const CrossValidation& validation);

/// Cross-validation over categories: for each fold a model is trained as the run's configuration says, with the fold's
/// categories held out of scores and training, and chooses views of these categories alone. Then the choices are
/// evaluated. Scores and models of a fold are kept in the folder fold-<number> of the run's folder, scores of all
/// categories, which say what the best views are, in the folder itself; those that fit are reused. Requires that no
/// category of the run is held out.
CrossValidation cross_validate(const Run& run, FeaturesStage& features, const std::vector<Fold>& folds,
                               FoldProblems problems = FoldProblems::all_categories);

}  // namespace svnet::train
