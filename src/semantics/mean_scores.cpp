#include "semantics/mean_scores.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::semantics {

SemanticScores mean_scores(std::span<const SemanticScores> scores) {
  check(!scores.empty(), "[scores] the mean of no scores");
  SemanticScores mean = scores[0];
  for (const SemanticScores& other : scores.subspan(1)) {
    check(other.count.size() == mean.count.size(), "[scores] the mean of scores of ", mean.count.size(), " and of ",
          other.count.size(), " views");
    mean.problems = std::min(mean.problems, other.problems);
    for (std::size_t v = 0; v < mean.count.size(); ++v) {
      mean.individual[v] += other.individual[v];
      mean.global[v] += other.global[v];
      mean.standard_error[v] += other.standard_error[v];
      mean.count[v] = std::min(mean.count[v], other.count[v]);
    }
  }
  const auto n = static_cast<double>(scores.size());
  for (auto* values : {&mean.individual, &mean.global, &mean.standard_error})
    for (double& value : *values) value /= n;
  return mean;
}

}  // namespace svnet::semantics
