#include "semantics/semantic_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace svnet {
namespace {

constexpr std::uint64_t kBlock = 16384;         // problems between two looks at the stopping rules
constexpr std::uint64_t kEnoughForError = 100;  // scores below which a standard error is not believed

void check_rules(const ScoreOptions& options) {
  check(options.target_error >= 0, "[scores] target_error is ", options.target_error, "; it must not be negative");
  check(options.problems > 0 || options.min_samples > 0 || options.target_error > 0,
        "[scores] nothing says when to stop; give problems, min_samples or target_error");
}

bool enough_samples(const ClusteringProblems& problems, const ScoreOptions& options, const ScoreSums& sums) {
  for (Index v = 0; v < problems.views(); ++v)
    if (problems.inclusion_probability(v) > 0 && sums.views[v].count < options.min_samples) return false;
  return true;
}

bool has_individual_score(const ClusteringProblems& problems, const ScoreOptions& options, Index view) {
  return problems.inclusion_probability(view) > 0 &&
         (options.singletons == Singletons::zero || problems.may_have_partner(view));
}

bool exact_enough(const ClusteringProblems& problems, const ScoreOptions& options, const ScoreSums& sums) {
  for (Index v = 0; v < problems.views(); ++v)
    if (has_individual_score(problems, options, v) &&
        (sums.views[v].individual_count < kEnoughForError || standard_error(sums.views[v]) > options.target_error))
      return false;
  return true;
}

bool finished(const ClusteringProblems& problems, const ScoreOptions& options, const ScoreSums& sums) {
  if (options.problems > 0 && sums.problems >= options.problems) return true;
  if (sums.problems == 0 || sums.problems % kBlock != 0) return false;
  return (options.min_samples > 0 && enough_samples(problems, options, sums)) ||
         (options.target_error > 0 && exact_enough(problems, options, sums));
}

/// The number of problems to expect; 0 where only the error decides.
std::uint64_t expected_problems(const ClusteringProblems& problems, const ScoreOptions& options) {
  std::uint64_t expected = options.problems;
  if (options.min_samples > 0) {
    double rarest = 1;
    for (Index v = 0; v < problems.views(); ++v)
      if (const double share = problems.inclusion_probability(v); share > 0) rarest = std::min(rarest, share);
    const auto needed = static_cast<std::uint64_t>(std::ceil(static_cast<double>(options.min_samples) / rarest));
    const std::uint64_t whole_blocks = (needed + kBlock - 1) / kBlock * kBlock;
    expected = expected == 0 ? whole_blocks : std::min(expected, whole_blocks);
  }
  return expected;
}

}  // namespace

void continue_scores(const DistanceMatrix& distances, const ClusteringProblems& problems, const ScoreOptions& options,
                     Parallel& parallel, ScoreSums& sums, const Messages& messages,
                     const std::function<void(const ScoreSums&)>& after_block) {
  check_rules(options);
  check(static_cast<Index>(sums.views.size()) == problems.views(), "[scores] the sums so far are of ",
        sums.views.size(), " views, the problems of ", problems.views());
  ProblemSolver solver(distances, problems, options.scoring(), parallel);
  Progress progress(messages, "semantic scores", static_cast<Index>(expected_problems(problems, options)));
  while (!finished(problems, options, sums)) {
    std::uint64_t border = (sums.problems / kBlock + 1) * kBlock;
    if (options.problems > 0) border = std::min(border, options.problems);
    solver.solve(sums.problems, border, sums);
    progress.update(static_cast<Index>(sums.problems));
    if (after_block) after_block(sums);
  }
}

SemanticScores semantic_scores(const DistanceMatrix& distances, const ClusteringProblems& problems,
                               const ScoreOptions& options, Parallel& parallel, const Messages& messages) {
  ScoreSums sums(problems.views());
  continue_scores(distances, problems, options, parallel, sums, messages);
  return scores_from(sums);
}

}  // namespace svnet
