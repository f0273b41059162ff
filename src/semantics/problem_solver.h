#pragma once
#include <cstdint>
#include <vector>

#include "semantics/clusterer.h"
#include "semantics/pair_scores.h"
#include "semantics/problem_batch.h"
#include "semantics/score_sums.h"

namespace svnet {

/// How problems are drawn, clustered and scored.
struct ProblemScoring {
  std::uint64_t seed = 0;
  Singletons singletons = Singletons::zero;
  ClusteringOptions clustering{};
};

/// Solves clustering problems and sums the scores of their views. Nothing is allocated per problem.
class ProblemSolver {
 public:
  /// Keeps references to all but the options; `parallel` must keep its number of threads. Throws Error where distances
  /// and problems differ in the number of views.
  ProblemSolver(const DistanceMatrix& distances, const ClusteringProblems& problems, const ProblemScoring& scoring,
                Parallel& parallel);

  /// Adds the problems numbered [first, last) to the sums. The same bits for any number of threads.
  void solve(std::uint64_t first, std::uint64_t last, ScoreSums& sums);

 private:
  /// What one thread works with.
  struct Worker {
    Clusterer clusterer;
    PairScores scores;
    std::vector<std::int32_t> truth, prediction;
    std::vector<double> individual;
    ScoreSums sums;
  };
  void prefetch(Index problem) const;
  void solve_one(Index problem, std::uint64_t number, Worker& worker) const;

  const ClusteringProblems& problems_;
  ProblemScoring scoring_;
  Parallel& parallel_;
  ProblemBatch batch_;
  std::vector<Worker> workers_;
};

}  // namespace svnet
