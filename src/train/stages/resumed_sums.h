#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/communicator.h"
#include "base/progress.h"
#include "semantics/semantic_scores.h"
#include "train/stages/resume.h"

namespace svnet::train {

/// Options that do not change the scores.
struct ScoringOptions {
  Resume resume = Resume::never;                         ///< from the snapshot
  double snapshot_seconds = 10;                          ///< from one snapshot to the next
  Communicator& communicator = SingleProcess::shared();  ///< shares the work; the root process reads and writes files
};

/// Adds problems to the sums until a stopping rule holds, as semantics::continue_scores does.
using AddProblems = std::function<void(semantics::ScoreSums& sums, const semantics::ScoreProgress& progress)>;

/// The sums of all problems. Goes on from the snapshot beside `path` (io/files/snapshot_path.h), as options.resume
/// says, and writes one from time to time and if `add` throws. A snapshot belongs to scores with this fingerprint.
semantics::ScoreSums resumed_sums(const std::filesystem::path& path, const std::string& fingerprint, Index views,
                                  const Messages& messages, const ScoringOptions& options, const AddProblems& add);

}  // namespace svnet::train
