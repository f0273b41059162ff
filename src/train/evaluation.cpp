#include "train/evaluation.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace svnet::train {
using semantics::ClusteringProblem;
using semantics::Contingency;

namespace {

/// The memory of one thread.
struct Worker {
  ClusteringProblem problem;
  std::vector<semantics::Clusterer> clusterers;  // per pipeline
  Contingency contingency;
  std::vector<std::int32_t> labels;
};

PerMetric<double> metrics_of(Worker& worker, std::size_t pipeline, const semantics::DistanceMatrix& distances,
                             std::uint64_t number, const EvaluationOptions& options) {
  const ClusteringProblem& problem = worker.problem;
  const auto labels = std::span(worker.labels).first(problem.rows.size());
  worker.clusterers[pipeline].cluster(distances, problem.rows, problem.categories, options.seed, number, labels);
  worker.contingency.count(problem.labels, labels);
  PerMetric<double> values{};
  for (std::size_t m = 0; m < kMetrics.size(); ++m) values[m] = kMetrics[m].value(worker.contingency, options.nmi);
  return values;
}

/// Mean and standard error of a sequence of values (Welford 1962).
struct RunningMean {
  double count = 0, mean = 0, squares = 0;

  void add(double value) {
    const double before = value - mean;
    mean += before / ++count;
    squares += before * (value - mean);
  }
  Mean result() const { return {mean, count > 1 ? std::sqrt(squares / (count - 1) / count) : std::nan("")}; }
};

}  // namespace

EvaluationTable evaluate(const ViewDataset& dataset, const semantics::ClusteringProblems& problems,
                         const std::vector<EvaluationPipeline>& pipelines, const std::vector<Selector>& selectors,
                         const EvaluationOptions& options, Parallel& parallel, const Messages& messages,
                         const std::string& task) {
  check(problems.poses() == static_cast<Index>(dataset.poses.size()),
        "[evaluation] the problems are of another dataset");
  std::vector<Worker> workers;
  for (int i = 0; i < parallel.threads(); ++i) {
    Worker worker{problems.new_problem(), {}, Contingency(problems.max_items()), {}};
    for (const auto& pipeline : pipelines)
      worker.clusterers.emplace_back(pipeline.clustering, problems.max_items(), problems.max_categories());
    worker.labels.resize(static_cast<std::size_t>(problems.max_items()));
    workers.push_back(std::move(worker));
  }

  const std::size_t stride = pipelines.size() * selectors.size();
  constexpr Index kBlock = 256;
  std::vector<PerMetric<double>> values(kBlock * stride);  // of one block of problems
  std::vector<PerMetric<RunningMean>> means(stride);
  Progress progress(messages, task, static_cast<Index>(options.problems));
  for (Index block = 0; block < static_cast<Index>(options.problems); block += kBlock) {
    const Index size = std::min(kBlock, static_cast<Index>(options.problems) - block);
    parallel.for_chunks(size, 4, [&](Index begin, Index end, int number) {
      Worker& worker = workers[static_cast<std::size_t>(number)];
      for (Index i = block + begin; i < block + end; ++i) {
        const auto problem_number = static_cast<std::uint64_t>(i);
        RandomStream poses(options.seed, Stream::evaluation, problem_number),
            views(options.seed, Stream::selector, problem_number);
        problems.draw_poses(poses, worker.problem);
        for (std::size_t s = 0; s < selectors.size(); ++s) {
          if (selectors[s].view.empty()) {
            problems.draw_views(views, worker.problem);
          } else {
            worker.problem.rows.clear();
            for (std::int32_t pose : worker.problem.poses)
              worker.problem.rows.push_back(selectors[s].view[static_cast<std::size_t>(pose)]);
          }
          for (std::size_t p = 0; p < pipelines.size(); ++p)
            values[static_cast<std::size_t>(i - block) * stride + p * selectors.size() + s] =
                metrics_of(worker, p, *pipelines[p].distances, problem_number, options);
        }
      }
    });
    for (std::size_t i = 0; i < static_cast<std::size_t>(size) * stride; ++i)
      for (std::size_t m = 0; m < kMetrics.size(); ++m) means[i % stride][m].add(values[i][m]);
    progress.update(block + size);
  }

  EvaluationTable table;
  table.problems = options.problems;
  for (const auto& selector : selectors) table.selectors.push_back(selector.name);
  for (std::size_t p = 0; p < pipelines.size(); ++p) {
    table.pipelines.push_back(pipelines[p].name);
    auto& row = table.cells.emplace_back(selectors.size());
    for (std::size_t s = 0; s < selectors.size(); ++s)
      for (std::size_t m = 0; m < kMetrics.size(); ++m) row[s][m] = means[p * selectors.size() + s][m].result();
  }
  return table;
}

}  // namespace svnet::train
