#include "semantics/set_scores.h"

namespace svnet::semantics {

void continue_set_scores(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
                         const ScoreOptions& options, Parallel& parallel, Communicator& communicator, ScoreSums& sums,
                         const ScoreProgress& callbacks) {
  ProblemSolver solver(distances, problems, options.scoring(), parallel, &sets);
  continue_scores([&](std::uint64_t first, std::uint64_t last, ScoreSums& to) { solver.solve(first, last, to); },
                  problems, options, communicator, sums, callbacks);
}

SemanticScores set_scores(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
                          const ScoreOptions& options, Parallel& parallel, const Messages& messages) {
  ScoreSums sums(problems.views());
  SingleProcess single_process;
  continue_set_scores(distances, sets, problems, options, parallel, single_process, sums,
                      {.messages = &messages, .after_step = {}});
  return scores_from(sums);
}

}  // namespace svnet::semantics
