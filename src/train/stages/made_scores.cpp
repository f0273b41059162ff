#include "train/stages/made_scores.h"

#include "base/text.h"
#include "io/files/snapshot_path.h"
#include "io/views/scores_file.h"
#include "semantics/mean_scores.h"
#include "semantics/score_sums.h"

namespace svnet::train {

Scores scores_of_sums(const semantics::ScoreSums& sums, std::span<const std::int32_t> pose, ScoresOrigin origin,
                      std::vector<std::string> paths) {
  semantics::SemanticScores made = scores_from(sums);
  origin.problems = static_cast<Index>(made.problems);
  Scores scores{std::move(origin),     std::move(made.individual),     std::move(made.global),     {},
                std::move(made.count), std::move(made.standard_error), rank_stability(sums, pose), std::move(paths)};
  scores.scaled = semantics::scaled_per_pose(scores.individual, pose);
  return scores;
}

Scores mean_of_backbones(const std::vector<Scores>& parts, const std::vector<std::string>& backbones,
                         std::span<const std::int32_t> pose, const std::string& fingerprint) {
  std::vector<semantics::SemanticScores> values;
  for (const Scores& part : parts)
    values.push_back(
        {part.individual, part.global, part.count, part.standard_error, static_cast<std::uint64_t>(part.problems)});
  semantics::SemanticScores mean = semantics::mean_scores(values);
  Scores scores = parts[0];
  scores.problems = static_cast<Index>(mean.problems);
  scores.sampler += "; mean of " + joined_with(", ", backbones);
  scores.input_fingerprint = fingerprint;
  scores.individual = std::move(mean.individual);
  scores.global = std::move(mean.global);
  scores.count = std::move(mean.count);
  scores.standard_error = std::move(mean.standard_error);
  scores.scaled = semantics::scaled_per_pose(scores.individual, pose);
  for (std::size_t v = 0; v < scores.rank_stability.size(); ++v) {
    for (std::size_t i = 1; i < parts.size(); ++i) scores.rank_stability[v] += parts[i].rank_stability[v];
    scores.rank_stability[v] /= static_cast<double>(parts.size());
  }
  return scores;
}

void write_made_scores(const std::filesystem::path& path, const Scores& scores) {
  io::write_scores(path, scores);
  std::error_code no_snapshot;
  std::filesystem::remove(io::snapshot_path(path), no_snapshot);
}

}  // namespace svnet::train
