#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "semantics/clusterer.h"
#include "semantics/pair_scores.h"
#include "semantics/problem_batch.h"
#include "semantics/score_sums.h"

namespace svnet::semantics {

/// Options for drawing, clustering and scoring problems.
struct ProblemScoring {
  std::uint64_t seed = 0;
  Singletons singletons = Singletons::zero;
  ClusteringOptions clustering{};
};

/// Solves clustering problems and sums the scores of their views, or sets of views. Nothing is allocated per problem.
class ProblemSolver {
 public:
  /// Keeps references to all arguments but `scoring`. With `sets` the problems are made from the category, object and
  /// pose of each set. Requires: `parallel` keeps its number of threads. Throws Error if distances and problems differ
  /// in the number of views; with sets, if those and problems differ in number or a set has an unknown view.
  ProblemSolver(const DistanceMatrix& distances, const ClusteringProblems& problems, const ProblemScoring& scoring,
                Parallel& parallel, const ViewSets* sets = nullptr);

  /// Adds the scores of problems [first, last) to the sums. The result has the same bits for any number of threads.
  void solve(std::uint64_t first, std::uint64_t last, ScoreSums& sums);

 private:
  /// The memory of one thread.
  struct Worker {
    Clusterer clusterer;
    PairScores scores;
    std::optional<SetDistances> sets;
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

}  // namespace svnet::semantics
