#include "semantics/problem_solver.h"

#include "base/error.h"

namespace svnet::semantics {
namespace {

constexpr Index kSolvedChunk = 64;  // problems that a thread solves as one chunk

const DistanceMatrix& checked(const DistanceMatrix& distances, const ClusteringProblems& problems,
                              const ViewSets* sets) {
  if (sets != nullptr) {
    check(sets->count() == problems.views(), "[sets] ", sets->count(), " sets, but problems of ", problems.views());
    for (const std::int32_t view : sets->views)
      check(view >= 0 && view < distances.size(), "[sets] a set has view ", view, " of ", distances.size());
    return distances;
  }
  check(distances.size() == problems.views(), "[scores] distances of ", distances.size(), " views, but problems of ",
        problems.views());
  return distances;
}

}  // namespace

ProblemSolver::ProblemSolver(const DistanceMatrix& distances, const ClusteringProblems& problems,
                             const ProblemScoring& scoring, Parallel& parallel, const ViewSets* sets)
    : problems_(problems),
      scoring_(scoring),
      parallel_(parallel),
      batch_(checked(distances, problems, sets), problems, parallel, sets) {
  const Index items = problems.max_items(), categories = problems.max_categories();
  for (int worker = 0; worker < parallel.threads(); ++worker) {
    std::optional<SetDistances> of_sets;
    if (sets != nullptr) of_sets.emplace(sets->size, sets->fusion, items);
    workers_.push_back({Clusterer(scoring.clustering, items, categories), PairScores(categories), std::move(of_sets),
                        std::vector<std::int32_t>(items), std::vector<std::int32_t>(items), std::vector<double>(items),
                        ScoreSums(problems.views())});
  }
}

/// Prefetches the distances of a problem while the one before it is solved.
void ProblemSolver::prefetch(Index problem) const {
  const LowerTriangle triangle = batch_.distances(problem);
  const float* end = triangle.values + LowerTriangle::size(triangle.points);
  for (const float* line = triangle.values; line < end; line += LowerTriangle::kLine) __builtin_prefetch(line);
}

void ProblemSolver::solve_one(Index problem, std::uint64_t number, Worker& worker) const {
  const auto drawn = batch_.items(problem);
  const std::size_t items = drawn.size();
  const std::span truth(worker.truth.data(), items), prediction(worker.prediction.data(), items);
  const std::span individual(worker.individual.data(), items);
  // Items are sorted by category.
  std::int32_t label = -1, category = -1;
  for (std::size_t i = 0; i < items; ++i) {
    const std::int32_t of_item = problems_.category_of_view(drawn[i]);
    label += of_item != category;
    category = of_item;
    truth[i] = label;
  }
  const LowerTriangle views = batch_.distances(problem);
  const LowerTriangle triangle = worker.sets ? worker.sets->of(views) : views;
  worker.clusterer.cluster(triangle, batch_.categories(problem), scoring_.seed, number, prediction);
  const double global = worker.scores.score(truth, prediction, scoring_.singletons, individual);
  worker.sums.add(drawn, number, global, individual);
}

void ProblemSolver::solve(std::uint64_t first, std::uint64_t last, ScoreSums& sums) {
  while (first < last) {
    const std::uint64_t count = batch_.draw(scoring_.seed, first, last - first);
    parallel_.for_chunks(count, kSolvedChunk, [&](Index begin, Index end, int worker) {
      for (Index p = begin; p < end; ++p) {
        if (p + 1 < end) prefetch(p + 1);
        solve_one(p, first + p, workers_[worker]);
      }
    });
    first += count;
  }
  for (auto& worker : workers_) sums.add_and_clear(worker.sums);
}

}  // namespace svnet::semantics
