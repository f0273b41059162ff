#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "data/scores.h"
#include "semantics/score_sums.h"

namespace svnet::train {

/// The scores of views, or of sets of views, from the sums of their problems, whose number becomes origin.problems.
/// `pose`: of each.
Scores scores_of_sums(const semantics::ScoreSums& sums, std::span<const std::int32_t> pose, ScoresOrigin origin,
                      std::vector<std::string> paths);

/// The mean of the scores of several backbones, of the same views or sets of views; `pose`: that of each. Rank
/// stability is the mean of theirs. The result has this fingerprint.
Scores mean_of_backbones(const std::vector<Scores>& parts, const std::vector<std::string>& backbones,
                         std::span<const std::int32_t> pose, const std::string& fingerprint);

/// Writes the scores to `path` and removes the snapshot that was left beside it.
void write_made_scores(const std::filesystem::path& path, const Scores& scores);

}  // namespace svnet::train
