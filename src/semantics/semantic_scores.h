#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/communicator.h"
#include "base/function_ref.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "semantics/problem_solver.h"

namespace svnet::semantics {

struct ScoreOptions {
  // Stopping rules. 0: off. At least one is needed; the first that holds stops.
  std::uint64_t problems = 0;     ///< stop after exactly N problems
  std::uint64_t min_samples = 0;  ///< stop once every view that can be drawn has been in at least N problems
  double target_error = 0;        ///< stop once every view has 100 scores and no standard error is larger

  std::uint64_t seed = 0;
  Singletons singletons = Singletons::zero;
  ClusteringOptions clustering{};

  ProblemScoring scoring() const { return {seed, singletons, clustering}; }
};

/// About how many problems a rule will stop after; 0 if only target_error stops.
std::uint64_t expected_problems(const ClusteringProblems& problems, const ScoreOptions& options);

/// Callbacks while scores are computed.
struct ScoreProgress {
  const Messages* messages = nullptr;
  /// Called about four times a second and at the end, in every process of the communicator. Saves snapshots.
  std::function<void(const ScoreSums&)> after_step;
};

/// Solves problems [first, last) and adds their scores to the sums.
using SolveProblems = FunctionRef<void(std::uint64_t first, std::uint64_t last, ScoreSums& sums)>;

/// Adds problems to `sums`, from problem sums.problems on, until a stopping rule holds. Requires: `sums` hold problems
/// 0 to sums.problems - 1, and all processes of the communicator have equal sums. Afterwards they are equal again.
///
/// min_samples and target_error are checked at multiples of 2^14 problems; from 2^21 problems on at multiples of 2^15,
/// from 2^22 on of 2^16, and so on. So the result depends neither on the number of threads or processes nor on
/// interruptions. Throws Error for options that cannot be fulfilled.
void continue_scores(const DistanceMatrix& distances, const ClusteringProblems& problems, const ScoreOptions& options,
                     Parallel& parallel, Communicator& communicator, ScoreSums& sums,
                     const ScoreProgress& callbacks = {});
/// The same for problems that are solved in another way.
void continue_scores(SolveProblems solve, const ClusteringProblems& problems, const ScoreOptions& options,
                     Communicator& communicator, ScoreSums& sums, const ScoreProgress& callbacks = {});

/// Semantic scores by Monte-Carlo (PAPER.md section 4): for each view, the means of its individual and global scores
/// over the random problems that contain it. Views of excluded categories have count 0 and scores NaN.
SemanticScores semantic_scores(const DistanceMatrix& distances, const ClusteringProblems& problems,
                               const ScoreOptions& options, Parallel& parallel, const Messages& messages = {});

}  // namespace svnet::semantics
