#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>

#include "base/communicator.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "semantics/clustering_problems.h"
#include "semantics/semantic_scores.h"
#include "train/config/config.h"

namespace svnet {

/// The random problems of a configuration over the categories of a dataset that are not excluded; fewer categories than
/// scores.min_categories lower that bound.
ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                       const Config::Scores& config);

/// How work on scores is kept safe and shared.
struct ScoresRun {
  /// Whether to go on from a snapshot: not at all, from one of the same scores, or from any there is, where one of
  /// other scores is an Error.
  enum class Resume { never, same, any } resume = Resume::never;
  double snapshot_seconds = 10;  ///< from one snapshot to the next
  Communicator& communicator =
      SingleProcess::shared();  ///< that shares the work; its first process reads and writes files
};

/// Makes the scores of every view as `config.scores` and `config.seed` say, views of excluded categories have none, and
/// writes them to `path`. A snapshot is kept at snapshot_path(path) while problems are solved. Rows of the features are
/// the dataset's views.
Scores make_scores(const std::filesystem::path& path, const ViewDataset& dataset, const Features& features,
                   const std::vector<bool>& excluded, const Config& config, const Messages& messages,
                   const ScoresRun& run);

/// How many problems views were in, and how well their scores are known. Means over nothing are NaN.
struct ScoresSummary {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max(), most = 0;  ///< problems of a view that was in any
  std::size_t left_out = 0;                                                    ///< views that were in none
  double largest_error = 0, mean_error = 0, mean_stability = 0;
};
ScoresSummary summary(const Scores& scores);

/// How well scores are known, in a line or two.
std::string certainty_text(const Scores& scores);

}  // namespace svnet
