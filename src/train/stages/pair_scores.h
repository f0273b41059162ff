#pragma once
#include "data/scores.h"
#include "semantics/view_sets.h"
#include "train/run.h"
#include "train/stages/features.h"

namespace svnet::train {

/// Semantic scores of pairs of views of the same pose.
struct PairScores {
  semantics::ViewSets pairs;
  Scores scores;  ///< of each pair; its path names both views
};

/// Pairs of views of each pose of the training categories: all of them, or this many that are drawn.
inline constexpr Index kMostPairsPerPose = 300;
semantics::ViewSets pairs_of_views(const ViewDataset& dataset, const std::vector<bool>& categories, std::uint64_t seed);

/// The configuration of the problems of pairs.
Config config_of_pairs(Config config);

/// The scores of these pairs, by the mean of both views' features, in pair-scores.h5: they say which view to take
/// beside another. Each backbone of the scores makes its own, and their mean is taken. Problems are as those of the
/// scores, with uniform views; there are ten times fewer of each pair (scores.min_samples), or the same number
/// (scores.problems), or errors may be three times as large (scores.target_error): a head learns from many pairs at
/// once.
PairScores pair_scores_stage(const Run& run, FeaturesStage& features);

}  // namespace svnet::train
