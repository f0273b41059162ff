#pragma once
#include <span>

#include "semantics/score_sums.h"

namespace svnet::semantics {

/// The mean over several scores of the same views, such as those of several backbones. A view that has no score in one
/// of them has none in the mean. Counts and the number of problems are the smallest. The standard error is the mean of
/// the standard errors: an upper bound, which is met if their errors are fully correlated; scores from one seed share
/// their problems, so their errors are correlated. Throws Error if there are none or the numbers of views differ.
SemanticScores mean_scores(std::span<const SemanticScores> scores);

}  // namespace svnet::semantics
