#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "data/scores.h"

namespace svnet::io {

// The HDF5 datasets are `individual`, `global`, `scaled`, `standard_error`, `rank_stability` (N) float64, `count` (N)
// uint64 and `paths` (N) UTF-8. The attributes of the root have the names of the members of ScoresOrigin.

/// Throws Error that names the file, the HDF5 dataset and the row unless
/// - all datasets have the same length, at least 1;
/// - scores are in [0, 1], standard errors not negative and rank stabilities in [-1, 1], or NaN;
/// - counts are at most the number of problems, and every view with a count above 0 has a global score.
Scores read_scores(const std::filesystem::path& path);

/// Replaces the file as a whole. Throws Error for scores that read_scores would refuse.
void write_scores(const std::filesystem::path& path, const Scores& scores);

/// The state of unfinished scoring, to resume from.
struct ScoresSnapshot {
  std::string input_fingerprint;  // that of the finished scores
  Index problems = 0;             // number of problems solved so far
  Index views = 0;
  std::vector<std::uint64_t> sums{};  // (views, sums per view), as the solver keeps them
};

// The HDF5 dataset is `sums` (views, sums per view) uint64; the attributes are `input_fingerprint`, `problems` and
// `checksum`, a SHA-256.

/// Throws Error for a file that is not a snapshot or is damaged.
ScoresSnapshot read_scores_snapshot(const std::filesystem::path& path);

/// Replaces the file as a whole.
void write_scores_snapshot(const std::filesystem::path& path, const ScoresSnapshot& snapshot);

}  // namespace svnet::io
