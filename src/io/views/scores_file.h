#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "data/scores.h"

namespace svnet {

// HDF5. Datasets: `individual`, `global`, `scaled`, `standard_error`, `rank_stability` (N) float64, `count` (N) uint64,
// `paths` (N) UTF-8. Attributes of the root: the members of ScoresOrigin, by these names.

/// Throws Error that names the file, the dataset and the row unless lengths agree, there is at least one view, scores
/// are in [0, 1] or NaN, standard errors are not negative or NaN, rank stabilities in [-1, 1] or NaN, and views with a
/// count, which is at most that of the problems, have a global score.
Scores read_scores(const std::filesystem::path& path);

/// Replaces the file as a whole. Throws Error where read_scores would.
void write_scores(const std::filesystem::path& path, const Scores& scores);

/// What is known while scores are being made, to go on from.
struct ScoresSnapshot {
  std::string input_fingerprint;  // as that of the scores to be
  Index problems = 0;             // solved so far
  Index views = 0;
  std::vector<std::uint64_t> sums{};  // (views, numbers of a view), as the solver keeps them
};

// HDF5. Dataset `sums` (views, numbers) uint64; attributes `input_fingerprint`, `problems`, `checksum`, a SHA-256.

/// Where the snapshot of a scores file lies: beside it.
std::filesystem::path snapshot_path(const std::filesystem::path& scores);

/// Throws Error for a file that is no snapshot, or not as it was written.
ScoresSnapshot read_scores_snapshot(const std::filesystem::path& path);

/// Replaces the file as a whole.
void write_scores_snapshot(const std::filesystem::path& path, const ScoresSnapshot& snapshot);

}  // namespace svnet
