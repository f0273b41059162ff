#pragma once
#include <filesystem>
#include <vector>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "semantics/clustering_problems.h"
#include "train/config/config.h"
#include "train/stages/features.h"
#include "train/stages/resumed_sums.h"
#include "train/stages/round_predictor.h"

namespace svnet::train {

/// The second stage: Monte-Carlo scores of every view, in scores.h5. Views of held-out categories have none. Resumes
/// from the snapshot of an interrupted run if its fingerprint matches.
///
/// With several backbones, scores-<backbone>.h5 are the scores of each, and scores.h5 is their mean. With
/// scores.rounds, scores are made again, N times: `predict` is given the scores of the round before, the views of each
/// pose are drawn by semantics::on_policy_weights of what it returns, and the files end in -round-<n>.h5. Returns the
/// scores of the last round.
Scores scores_stage(const Run& run, FeaturesStage& features, const RoundPredictor& predict);
/// With the predictions of sv_net_round_predictor.
Scores scores_stage(const Run& run, FeaturesStage& features);
/// Without rounds: views are drawn uniformly, so that the scores do not depend on a model.
Scores uniform_scores_stage(const Run& run, FeaturesStage& features);

/// Computes the scores of every view with `config.scores` and `config.seed`, but for rounds: views are drawn by
/// `weights`, uniformly if it is empty. Views of excluded categories have none. Writes a snapshot to
/// snapshot_path(path) from time to time, and if messages.progress throws. Requires: the rows of the features are the
/// dataset's views.
Scores make_scores(const std::filesystem::path& path, const ViewDataset& dataset, const Features& features,
                   const std::vector<bool>& excluded, const Config& config, const Messages& messages,
                   const ScoringOptions& options, const semantics::ViewWeights& weights = {});

}  // namespace svnet::train
