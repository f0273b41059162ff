#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "data/scores.h"

namespace svnet::train {

/// The mean of the scores of several backbones, of the same views or sets of views; `pose`: that of each. Rank
/// stability is the mean of theirs. The result has this fingerprint.
Scores mean_of_backbones(const std::vector<Scores>& parts, const std::vector<std::string>& backbones,
                         std::span<const std::int32_t> pose, const std::string& fingerprint);

/// Writes the scores to `path` and removes the snapshot that was left beside it.
void write_made_scores(const std::filesystem::path& path, const Scores& scores);

}  // namespace svnet::train
