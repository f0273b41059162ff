#pragma once
#include <cstdint>
#include <functional>
#include <vector>

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

/// Continues `sums`, which hold the problems numbered from 0 to sums.problems - 1, until the options say stop. Only at
/// multiples of 16384 problems is asked whether min_samples or target_error is reached, so that the result depends
/// neither on the number of threads nor on interruptions. `after_block`, if any, is called at each border and at the
/// end: to save a snapshot. Throws Error for options that cannot be followed.
void continue_scores(const DistanceMatrix& distances, const ClusteringProblems& problems, const ScoreOptions& options,
                     Parallel& parallel, ScoreSums& sums, const Messages& messages = {},
                     const std::function<void(const ScoreSums&)>& after_block = {});

/// Semantic scores of every view by Monte-Carlo (PAPER.md section 4): for each, the mean of its Fowlkes-Mallows scores,
/// individual and global, over the random problems that contain it. Views of excluded categories get count 0 and NaN.
SemanticScores semantic_scores(const DistanceMatrix& distances, const ClusteringProblems& problems,
                               const ScoreOptions& options, Parallel& parallel, const Messages& messages = {});

}  // namespace svnet
