// problem/<clustering>/<problems>: random problems of the paper's size (24 categories x 5 objects x 3 poses x 21
// views), drawn, clustered and scored on one thread. distances/<views>/<features>: a matrix of squared distances.
#include <benchmark/benchmark.h>

#include "semantics/problem_solver.h"

namespace svnet {
using semantics::Clustering;
using semantics::ClusteringOptions;

namespace {

struct Paper {
  std::vector<std::int64_t> category, object, pose;
  std::vector<float> features;
  static constexpr Index kFeatures = 64;  // few suffice: problems use only distances

  Paper() {
    RandomStream random(1, Stream::shuffle);
    std::vector<float> centres(24 * kFeatures);
    for (auto& value : centres) value = static_cast<float>(random.normal());
    for (Index c = 0; c < 24; ++c)
      for (Index o = 0; o < 5; ++o)
        for (Index p = 0; p < 3; ++p)
          for (Index v = 0; v < 21; ++v) {
            category.push_back(c);
            object.push_back(o);
            pose.push_back(p);
            for (Index d = 0; d < kFeatures; ++d)
              features.push_back(centres[c * kFeatures + d] + 1.5f * static_cast<float>(random.normal()));
          }
  }
  Index views() const { return static_cast<Index>(category.size()); }
};

const Paper& paper() {
  static const Paper made;
  return made;
}

void problem(benchmark::State& state, const ClusteringOptions& clustering) {
  static const semantics::DistanceMatrix distances =
      semantics::squared_distances(paper().features.data(), paper().views(), Paper::kFeatures, Parallel::shared());
  const semantics::ClusteringProblems problems(paper().category, paper().object, paper().pose);
  Parallel one(1);
  semantics::ProblemSolver solver(distances, problems, {.clustering = clustering}, one);
  semantics::ScoreSums sums(problems.views());
  const auto batch = static_cast<std::uint64_t>(state.range(0));
  solver.solve(0, batch, sums);  // first use of the memory
  std::uint64_t first = batch;
  for (auto _ : state) {
    solver.solve(first, first + batch, sums);
    first += batch;
  }
  state.counters["seconds_per_problem"] = benchmark::Counter(
      static_cast<double>(batch), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void distance_matrix(benchmark::State& state) {
  const Index views = 7560, features = state.range(0);
  std::vector<float> values(static_cast<std::size_t>(views * features));
  RandomStream random(1, Stream::shuffle);
  for (auto& value : values) value = static_cast<float>(random.uniform());
  for (auto _ : state)
    benchmark::DoNotOptimize(semantics::squared_distances(values.data(), views, features, Parallel::shared()).row(0));
}

const bool kRegistered = [] {
  for (const auto method : {Clustering::ward, Clustering::average, Clustering::complete, Clustering::single})
    benchmark::RegisterBenchmark(("problem/" + std::string(name_of(method))).c_str(), problem,
                                 ClusteringOptions{.method = method})
        ->Arg(16384)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  benchmark::RegisterBenchmark("problem/kmeans", problem,
                               ClusteringOptions{.method = Clustering::kmeans, .dimension = Paper::kFeatures})
      ->Arg(2048)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RegisterBenchmark("distances/7560", distance_matrix)
      ->Arg(2048)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  return true;
}();

}  // namespace
}  // namespace svnet
