#pragma once
#include "semantics/semantic_scores.h"
#include "semantics/view_sets.h"

namespace svnet::semantics {

/// Adds problems whose items are sets of views to `sums`, which has an element per set, as continue_scores does. The
/// problems are those of the sets: ClusteringProblems made from the category, object and pose of each set. The same
/// bits for any number of threads and processes.
void continue_set_scores(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
                         const ScoreOptions& options, Parallel& parallel, Communicator& communicator, ScoreSums& sums,
                         const ScoreProgress& callbacks = {});

/// Semantic scores of sets of views: the means of their individual and global scores over the random problems that
/// contain them.
SemanticScores set_scores(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
                          const ScoreOptions& options, Parallel& parallel, const Messages& messages = {});

}  // namespace svnet::semantics
