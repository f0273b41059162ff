#pragma once
#include <string>
#include <vector>

#include "train/evaluation.h"
#include "train/run.h"
#include "train/stages/features.h"
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

struct FoldResult {
  Fold held_out;
  WithinPose within_pose;  ///< of the fold's categories
};

struct CrossValidation {
  EvaluationTable table;   ///< over all categories, with the view of each pose that was chosen without its category
  WithinPose within_pose;  ///< over all categories
  std::vector<FoldResult> folds;
};

/// Cross-validation over categories: for each fold a model is trained as the run's configuration says, with the fold's
/// categories held out of scores and training, and chooses views of these categories alone. Then all choices are
/// evaluated together. Scores and models of a fold are kept in the folder fold-<number> of the run's folder, scores of
/// all categories in the folder itself; those that fit are reused. Requires that no category of the run is held out.
CrossValidation cross_validate(const Run& run, FeaturesStage& features, const std::vector<Fold>& folds);

}  // namespace svnet::train
