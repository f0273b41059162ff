#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "predict/predictor.h"
#include "train/selectors.h"

namespace svnet::sorting {

/// The score that a model predicts for every view, from the top image of its pose. Throws Error that names a file that
/// cannot be read, or the depth image that is missing.
std::vector<double> predicted_scores(const ViewDataset& dataset, const predict::Predictor& predictor,
                                     const Messages& messages, Parallel& parallel);

/// The selectors that a simulation compares:
///   top        the top view
///   rand       a random view
///   broadside  the view at phi 45 across the object's axis, a fixed rule
///   svnet      the view with the best score of `predicted`
///   top_svnet  the top view and that view, for no more moves
///   move_50    that view for the half of the objects that gain most by the predictions, the top view for the others
///   svnet_2    the two views to take together, by `predicted`
///   opt        the limit: the view with the best semantic score, of kOptProblems problems of the dataset's categories
/// Those of svnet only if `predicted` is not empty. `features`: (views, dimension).
std::vector<train::Selector> view_selectors(const ViewDataset& dataset, std::span<const float> features,
                                            std::span<const double> predicted, std::uint64_t seed,
                                            const Messages& messages, Parallel& parallel);

inline constexpr std::uint64_t kOptProblems = 100'000;

}  // namespace svnet::sorting
