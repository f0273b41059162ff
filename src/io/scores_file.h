#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/index.h"

namespace svnet {

/// How scores were made.
struct ScoresOrigin {
  Index problems = 0;  // clustering problems drawn
  std::uint64_t seed = 0;
  std::string sampler;            // how problems are drawn
  std::string clustering;         // "ward", "kmeans"
  std::string metric;             // "fm", …
  std::string input_fingerprint;  // of everything that the values depend on: scores with the same one are the same
};

/// The semantic scores of every view of a dataset; entry i belongs to paths[i]. NaN: there is none, because the view
/// was in no problem (count 0, as excluded views are) or in none that counts.
struct Scores : ScoresOrigin {
  std::vector<double> individual;      // mean individual score, [0, 1]
  std::vector<double> global;          // mean score of the problems with this view, [0, 1]
  std::vector<double> scaled;          // the training target: scaled to [0, 1] among the views of a pose
  std::vector<std::uint64_t> count;    // problems with this view
  std::vector<double> standard_error;  // of `individual`
  std::vector<double> rank_stability;  // of the view's pose: Kendall's tau of its views' order between half the
                                       // problems and the other half, [-1, 1]
  std::vector<std::string> paths;      // as the dataset names its images
};

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
