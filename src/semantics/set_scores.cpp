#include "semantics/set_scores.h"

#include "base/error.h"

namespace svnet::semantics {
namespace {

/// Solves problems of sets and sums the scores of the sets. Nothing is allocated per problem.
class SetSolver {
 public:
  SetSolver(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
            const ProblemScoring& scoring, Parallel& parallel)
      : sets_(sets), problems_(problems), scoring_(scoring), parallel_(parallel) {
    const Index items = problems.max_items(), categories = problems.max_categories();
    for (int worker = 0; worker < parallel.threads(); ++worker)
      workers_.push_back({problems.new_problem(), SetDistances(distances, sets.size, sets.fusion, items),
                          Clusterer(scoring.clustering, items, categories), PairScores(categories),
                          std::vector<std::int32_t>(static_cast<std::size_t>(items * sets.size)),
                          std::vector<std::int32_t>(static_cast<std::size_t>(items)),
                          std::vector<double>(static_cast<std::size_t>(items)), ScoreSums(problems.views())});
  }

  void solve(std::uint64_t first, std::uint64_t last, ScoreSums& sums) {
    constexpr Index kChunk = 64;
    parallel_.for_chunks(static_cast<Index>(last - first), kChunk, [&](Index begin, Index end, int worker) {
      for (Index p = begin; p < end; ++p)
        solve_one(first + static_cast<std::uint64_t>(p), workers_[static_cast<std::size_t>(worker)]);
    });
    for (Worker& worker : workers_) sums.add_and_clear(worker.sums);
  }

 private:
  struct Worker {
    ClusteringProblem problem;
    SetDistances distances;
    Clusterer clusterer;
    PairScores scores;
    std::vector<std::int32_t> views, prediction;
    std::vector<double> individual;
    ScoreSums sums;
  };

  void solve_one(std::uint64_t number, Worker& w) const {
    problems_.draw(scoring_.seed, number, w.problem);
    const auto& items = w.problem.rows;
    auto to = w.views.begin();
    for (const std::int32_t item : items) to = std::ranges::copy(sets_.set(item), to).out;
    const LowerTriangle triangle = w.distances.of(std::span(w.views.begin(), to));
    const std::span prediction = std::span(w.prediction).first(items.size());
    const std::span individual = std::span(w.individual).first(items.size());
    w.clusterer.cluster(triangle, w.problem.categories, scoring_.seed, number, prediction);
    const double global = w.scores.score(w.problem.labels, prediction, scoring_.singletons, individual);
    w.sums.add(items, number, global, individual);
  }

  const ViewSets& sets_;
  const ClusteringProblems& problems_;
  ProblemScoring scoring_;
  Parallel& parallel_;
  std::vector<Worker> workers_;
};

}  // namespace

void continue_set_scores(const DistanceMatrix& distances, const ViewSets& sets, const ClusteringProblems& problems,
                         const ScoreOptions& options, Parallel& parallel, Communicator& communicator, ScoreSums& sums,
                         const ScoreProgress& callbacks) {
  check(sets.count() == problems.views(), "[sets] ", sets.count(), " sets, but problems of ", problems.views());
  for (const std::int32_t view : sets.views)
    check(view >= 0 && view < distances.size(), "[sets] a set has view ", view, " of ", distances.size());
  SetSolver solver(distances, sets, problems, options.scoring(), parallel);
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
