#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/communicator.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "semantics/problem_solver.h"

namespace svnet {

struct ScoreOptions {
  // When to stop: at the first of those that are not 0. At least one is needed.
  std::uint64_t problems = 0;     ///< after this many problems, exactly
  std::uint64_t min_samples = 0;  ///< when every view that can be drawn was in this many problems
  double target_error = 0;        ///< when every standard error is at most this, from at least 100 scores

  std::uint64_t seed = 0;
  Singletons singletons = Singletons::zero;
  ClusteringOptions clustering{};

  ProblemScoring scoring() const { return {seed, singletons, clustering}; }
};

/// What goes on while scores are computed.
struct ScoreProgress {
  const Messages* messages = nullptr;
  /// Called about four times a second and at the end, in every process of the communicator: to save a snapshot.
  std::function<void(const ScoreSums&)> after_step;
};

/// Continues `sums`, which hold the problems numbered from 0 to sums.problems - 1, until the options say stop. Whether
/// min_samples or target_error is reached is asked at multiples of 16384 problems, from 2^21 problems on only at
/// multiples of 2^15, from 2^22 on of 2^16, and so on: the result depends neither on the number of threads or processes
/// nor on interruptions. Every process of the communicator holds the same sums, before and after. Throws Error for
/// options that cannot be followed.
void continue_scores(const DistanceMatrix& distances, const ClusteringProblems& problems, const ScoreOptions& options,
                     Parallel& parallel, Communicator& communicator, ScoreSums& sums, const ScoreProgress& watch = {});

/// Semantic scores of every view by Monte-Carlo (PAPER.md section 4): for each, the mean of its Fowlkes-Mallows scores,
/// individual and global, over the random problems that contain it. Views of excluded categories get count 0 and NaN.
SemanticScores semantic_scores(const DistanceMatrix& distances, const ClusteringProblems& problems,
                               const ScoreOptions& options, Parallel& parallel, const Messages& messages = {});

}  // namespace svnet
