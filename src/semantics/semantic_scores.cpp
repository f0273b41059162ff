#include "semantics/semantic_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace svnet::semantics {
namespace {

constexpr std::uint64_t kBlock = 16384;         // problems between two checks of the stopping rules, at first
constexpr std::uint64_t kBlocksPerCheck = 128;  // from this number of blocks on, checks become rarer
constexpr std::uint64_t kFirstStep = 512;       // problems in the first step, before their speed is known
constexpr std::uint64_t kEnoughForError = 100;  // scores; a standard error of fewer is not used

void check_rules(const ScoreOptions& options) {
  check(options.target_error >= 0, "[scores] target_error is ", options.target_error, "; it must not be negative");
  check(options.problems > 0 || options.min_samples > 0 || options.target_error > 0,
        "[scores] nothing says when to stop; give problems, min_samples or target_error");
  const auto check_most = [](const char* name, std::uint64_t wanted) {
    check(wanted <= ScoreSums::kMostProblems, "[scores] ", name, " is ", wanted, "; the sums hold ",
          ScoreSums::kMostProblems, " problems");
  };
  check_most("problems", options.problems);
  check_most("min_samples", options.min_samples);
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

/// The first number of problems above `problems` at which the stopping rules are checked.
std::uint64_t next_check(std::uint64_t problems) {
  std::uint64_t between = kBlock;
  while (problems >= between * kBlocksPerCheck) between *= 2;
  return (problems / between + 1) * between;
}

bool is_check_due(std::uint64_t problems) { return problems > 0 && next_check(problems - 1) == problems; }

bool finished(const ClusteringProblems& problems, const ScoreOptions& options, const ScoreSums& sums) {
  if (options.problems > 0 && sums.problems >= options.problems) return true;
  if (!is_check_due(sums.problems)) return false;
  return (options.min_samples > 0 && enough_samples(problems, options, sums)) ||
         (options.target_error > 0 && exact_enough(problems, options, sums));
}

}  // namespace

std::uint64_t expected_problems(const ClusteringProblems& problems, const ScoreOptions& options) {
  std::uint64_t expected = options.problems;
  if (options.min_samples > 0) {
    double rarest = 1;
    for (Index v = 0; v < problems.views(); ++v)
      if (const double share = problems.inclusion_probability(v); share > 0) rarest = std::min(rarest, share);
    // The unluckiest of thousands of views is about four standard deviations below its mean.
    const double samples = options.min_samples, shortfall = 4 * std::sqrt(samples) + 8;
    const auto needed = static_cast<std::uint64_t>(std::ceil((samples + shortfall) / rarest));
    const std::uint64_t at_check = needed == 0 ? 0 : next_check(needed - 1);
    expected = expected == 0 ? at_check : std::min(expected, at_check);
  }
  return expected;
}

void continue_scores(const DistanceMatrix& distances, const ClusteringProblems& problems, const ScoreOptions& options,
                     Parallel& parallel, Communicator& communicator, ScoreSums& sums, const ScoreProgress& callbacks) {
  ProblemSolver solver(distances, problems, options.scoring(), parallel);
  continue_scores([&](std::uint64_t first, std::uint64_t last, ScoreSums& to) { solver.solve(first, last, to); },
                  problems, options, communicator, sums, callbacks);
}

void continue_scores(SolveProblems solve, const ClusteringProblems& problems, const ScoreOptions& options,
                     Communicator& communicator, ScoreSums& sums, const ScoreProgress& callbacks) {
  check_rules(options);
  check(std::ssize(sums.views) == problems.views(), "[scores] the sums so far are of ", sums.views.size(),
        " views, the problems of ", problems.views());
  static const Messages kSilent;
  const std::uint64_t start = sums.problems, expected = expected_problems(problems, options);
  Progress progress(callbacks.messages == nullptr ? kSilent : *callbacks.messages, "semantic scores",
                    expected > start ? expected - start : 0);
  ScoreSums step(problems.views());
  while (!finished(problems, options, sums)) {
    const std::uint64_t done = sums.problems - start;
    const std::uint64_t in_a_quarter =
        done == 0 ? kFirstStep : static_cast<std::uint64_t>(done / progress.seconds() / 4);
    std::uint64_t last = std::min(next_check(sums.problems), sums.problems + std::max<std::uint64_t>(in_a_quarter, 1));
    if (options.problems > 0) last = std::min(last, options.problems);
    check(last <= ScoreSums::kMostProblems, "[scores] ", sums.problems,
          " problems are solved and the rules ask for more; ", "the sums hold ", ScoreSums::kMostProblems,
          ": raise target_error or lower min_samples");
    last = communicator.broadcast(last);
    const Share share = share_of(communicator, sums.problems, last);
    solve(share.first, share.last, step);
    communicator.all_reduce(step.values());
    step.problems = last - sums.problems;
    sums.add_and_clear(step);
    // The expected number may be too low, but progress must not show the end before it is reached.
    std::uint64_t shown = sums.problems - start;
    if (expected > start && !finished(problems, options, sums)) shown = std::min(shown, expected - start - 1);
    progress.update(shown);
    if (callbacks.after_step) callbacks.after_step(sums);
  }
}

SemanticScores semantic_scores(const DistanceMatrix& distances, const ClusteringProblems& problems,
                               const ScoreOptions& options, Parallel& parallel, const Messages& messages) {
  ScoreSums sums(problems.views());
  SingleProcess single_process;
  continue_scores(distances, problems, options, parallel, single_process, sums,
                  {.messages = &messages, .after_step = {}});
  return scores_from(sums);
}

}  // namespace svnet::semantics
