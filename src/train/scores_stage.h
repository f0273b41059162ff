#pragma once
#include <filesystem>

#include "base/progress.h"
#include "base/team.h"
#include "io/features_file.h"
#include "io/scores_file.h"
#include "io/view_dataset.h"
#include "semantics/clustering_problems.h"
#include "train/config/config.h"

namespace svnet {

/// The random problems of a configuration over the categories of a dataset that are not excluded; fewer categories than
/// scores.min_categories lower that bound.
ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                       const Config::Scores& config);

/// Changes with everything that the scores of these features depend on.
std::string scores_fingerprint(const std::string& features_fingerprint, const Config& config);

/// How long work on scores is kept safe and shared.
struct ScoresRun {
  std::filesystem::path snapshot;  ///< rewritten while problems are solved; empty: none
  double snapshot_seconds = 10;    ///< from one to the next
  bool resume = false;             ///< go on from the snapshot, where there is one
  Team* team = nullptr;            ///< that shares the work; its process 0 writes snapshots
};

/// Scores of every view as `config.scores` and `config.seed` say; views of excluded categories have none. Rows of the
/// features are the dataset's views. Throws Error for a snapshot of other scores.
Scores make_scores(const ViewDataset& dataset, const Features& features, const std::vector<bool>& excluded,
                   const Config& config, const Messages& messages, const ScoresRun& run = {});

/// How well scores are known, in a line or two.
std::string certainty_text(const Scores& scores);

}  // namespace svnet
