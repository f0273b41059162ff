#include "train/evaluation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "semantics/co_association.h"

namespace svnet::train {
using semantics::ClusteringProblem;
using semantics::Contingency;

namespace {

/// The memory of one thread.
struct Worker {
  ClusteringProblem problem;
  std::vector<semantics::Clusterer> clusterers;   // per pipeline
  std::map<Index, semantics::SetDistances> sets;  // by the number of views
  Contingency contingency;
  std::vector<std::int32_t> labels;
};

/// Labels by co-association of the clusterings of each view.
void vote(Worker& worker, semantics::Clusterer& clusterer, const semantics::DistanceMatrix& distances, Index views,
          std::uint64_t number, std::uint64_t seed, std::span<std::int32_t> labels) {
  const ClusteringProblem& problem = worker.problem;
  std::vector<std::int64_t> votes;
  std::vector<std::int32_t> rows(labels.size());
  for (Index view = 0; view < views; ++view) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = problem.rows[i * static_cast<std::size_t>(views) + static_cast<std::size_t>(view)];
    clusterer.cluster(distances, rows, problem.categories, seed, number, labels);
    votes.insert(votes.end(), labels.begin(), labels.end());
  }
  std::ranges::copy(semantics::co_association(votes, static_cast<Index>(labels.size()), problem.categories),
                    labels.begin());
}

/// The metrics of the worker's problem, whose items have one view or sets of views.
PerMetric<double> metrics_of(Worker& worker, std::size_t pipeline, const semantics::DistanceMatrix& distances,
                             Index views, std::uint64_t number, const EvaluationOptions& options) {
  const ClusteringProblem& problem = worker.problem;
  const auto labels = std::span(worker.labels).first(problem.labels.size());
  semantics::Clusterer& clusterer = worker.clusterers[pipeline];
  if (views == 1)
    clusterer.cluster(distances, problem.rows, problem.categories, options.seed, number, labels);
  else if (options.fusion == ViewsTogether::votes)
    vote(worker, clusterer, distances, views, number, options.seed, labels);
  else
    clusterer.cluster(worker.sets.at(views).of(distances, problem.rows), problem.categories, options.seed, number,
                      labels);
  worker.contingency.count(problem.labels, labels);
  PerMetric<double> values{};
  for (std::size_t m = 0; m < kMetrics.size(); ++m) values[m] = kMetrics[m].value(worker.contingency, options.nmi);
  return values;
}

/// Puts the views that the selector chooses into the problem.
void choose_views(const semantics::ClusteringProblems& problems, const Selector& selector, RandomStream& random,
                  ClusteringProblem& problem) {
  if (selector.view.empty()) return problems.draw_views(random, problem, selector.views);
  problem.rows.clear();
  for (const std::int32_t pose : problem.poses) {
    const auto first = selector.view.begin() + pose * selector.views;
    problem.rows.insert(problem.rows.end(), first, first + selector.views);
  }
}

/// Mean and standard error of a sequence of values (Welford 1962).
struct RunningMean {
  double count = 0, mean = 0, squares = 0;

  void add(double value) {
    const double before = value - mean;
    mean += before / ++count;
    squares += before * (value - mean);
  }
  Mean result() const { return {mean, count > 1 ? std::sqrt(squares / (count - 1) / count) : std::nan(""), {}}; }
};

std::vector<std::int32_t> categories_of(const ViewDataset& dataset, const ClusteringProblem& problem) {
  std::vector<std::int32_t> categories;
  for (const std::int32_t pose : problem.poses) {
    const auto category = static_cast<std::int32_t>(dataset.poses[static_cast<std::size_t>(pose)].category);
    if (std::find(categories.begin(), categories.end(), category) == categories.end()) categories.push_back(category);
  }
  return categories;
}

/// All selectors minus the selector `baseline`, as EvaluationTable has them.
std::vector<std::vector<PerMetric<Difference>>> differences_from(std::size_t baseline, const ProblemValues& values,
                                                                 std::size_t pipelines, std::size_t selectors,
                                                                 const EvaluationOptions& options, Parallel& parallel) {
  const std::size_t metrics = kMetrics.size(), rows = pipelines + (pipelines > 1 ? 1 : 0);
  const std::size_t from = pipelines * selectors * metrics, to = rows * selectors * metrics;
  ProblemValues differences{.columns = static_cast<Index>(to),
                            .values = std::vector<double>(static_cast<std::size_t>(values.problems()) * to),
                            .categories = values.categories,
                            .first_category = values.first_category};
  std::vector<RunningMean> means(to);
  for (std::size_t problem = 0; problem < static_cast<std::size_t>(values.problems()); ++problem) {
    const double* value = values.values.data() + problem * from;
    double* difference = differences.values.data() + problem * to;
    for (std::size_t p = 0; p < pipelines; ++p)
      for (std::size_t s = 0; s < selectors; ++s)
        for (std::size_t m = 0; m < metrics; ++m) {
          const double ahead =
              value[(p * selectors + s) * metrics + m] - value[(p * selectors + baseline) * metrics + m];
          difference[(p * selectors + s) * metrics + m] = ahead;
          if (rows > pipelines)
            difference[(pipelines * selectors + s) * metrics + m] += ahead / static_cast<double>(pipelines);
        }
    for (std::size_t c = 0; c < to; ++c) means[c].add(difference[c]);
  }
  const std::vector<Interval> intervals = category_intervals(differences, {.seed = options.seed}, parallel);
  std::vector<std::vector<PerMetric<Difference>>> table(rows, std::vector<PerMetric<Difference>>(selectors));
  for (std::size_t c = 0; c < to; ++c)
    table[c / metrics / selectors][c / metrics % selectors][c % metrics] = {means[c].mean, intervals[c]};
  return table;
}

EvaluationTable table_of(const ProblemValues& values, const std::vector<EvaluationPipeline>& pipelines,
                         const std::vector<Selector>& selectors, const EvaluationOptions& options, Parallel& parallel) {
  EvaluationTable table;
  table.problems = options.problems;
  for (const auto& selector : selectors) table.selectors.push_back(selector.name);
  for (const auto& pipeline : pipelines) table.pipelines.push_back(pipeline.name);
  std::vector<RunningMean> means(static_cast<std::size_t>(values.columns));
  for (std::size_t i = 0; i < values.values.size(); ++i) means[i % means.size()].add(values.values[i]);
  const std::vector<Interval> intervals = category_intervals(values, {.seed = options.seed}, parallel);
  const std::size_t metrics = kMetrics.size();
  table.cells.assign(pipelines.size(), std::vector<PerMetric<Mean>>(selectors.size()));
  for (std::size_t c = 0; c < means.size(); ++c) {
    Mean& cell = table.cells[c / metrics / selectors.size()][c / metrics % selectors.size()][c % metrics];
    cell = means[c].result();
    cell.interval = intervals[c];
  }
  for (std::size_t s = 0; s < selectors.size(); ++s)
    if (std::find(options.baselines.begin(), options.baselines.end(), selectors[s].name) != options.baselines.end())
      table.differences[selectors[s].name] =
          differences_from(s, values, pipelines.size(), selectors.size(), options, parallel);
  return table;
}

/// Solves the problems with the numbers `first` to `last` - 1, which are of one set, and puts their values and
/// categories into `values`.
void solve(const ViewDataset& dataset, const EvaluationSet& set, const std::vector<EvaluationPipeline>& pipelines,
           Index first, Index last, const EvaluationOptions& options, Parallel& parallel, Progress& progress,
           ProblemValues& values) {
  const semantics::ClusteringProblems& problems = set.problems;
  check(problems.poses() == static_cast<Index>(dataset.poses.size()),
        "[evaluation] the problems are of another dataset");
  std::vector<Worker> workers;
  for (int i = 0; i < parallel.threads(); ++i) {
    Worker worker{problems.new_problem(), {}, {}, Contingency(problems.max_items()), {}};
    for (const auto& pipeline : pipelines)
      worker.clusterers.emplace_back(pipeline.clustering, problems.max_items(), problems.max_categories());
    for (const Selector& selector : set.selectors)
      if (selector.views > 1 && options.fusion != ViewsTogether::votes)
        worker.sets.try_emplace(
            selector.views, selector.views,
            options.fusion == ViewsTogether::mean ? semantics::ViewFusion::mean : semantics::ViewFusion::concatenate,
            problems.max_items());
    worker.labels.resize(static_cast<std::size_t>(problems.max_items()));
    workers.push_back(std::move(worker));
  }

  const std::size_t selectors = set.selectors.size(), stride = pipelines.size() * selectors * kMetrics.size();
  constexpr Index kBlock = 256;
  std::vector<std::vector<std::int32_t>> categories(kBlock);  // of each problem of a block
  for (Index block = first; block < last; block += kBlock) {
    const Index size = std::min(kBlock, last - block);
    parallel.for_chunks(size, 4, [&](Index begin, Index end, int number) {
      Worker& worker = workers[static_cast<std::size_t>(number)];
      for (Index i = block + begin; i < block + end; ++i) {
        const auto problem_number = static_cast<std::uint64_t>(i);
        RandomStream poses(options.seed, Stream::evaluation, problem_number),
            views(options.seed, Stream::selector, problem_number);
        problems.draw_poses(poses, worker.problem);
        categories[static_cast<std::size_t>(i - block)] = categories_of(dataset, worker.problem);
        for (std::size_t s = 0; s < selectors; ++s) {
          choose_views(problems, set.selectors[s], views, worker.problem);
          for (std::size_t p = 0; p < pipelines.size(); ++p) {
            const auto metrics =
                metrics_of(worker, p, *pipelines[p].distances, set.selectors[s].views, problem_number, options);
            std::copy(metrics.begin(), metrics.end(),
                      values.values.begin() +
                          static_cast<std::ptrdiff_t>(problem_number * stride + (p * selectors + s) * kMetrics.size()));
          }
        }
      }
    });
    for (Index i = 0; i < size; ++i) {
      const auto& of_problem = categories[static_cast<std::size_t>(i)];
      values.categories.insert(values.categories.end(), of_problem.begin(), of_problem.end());
      values.first_category.push_back(values.categories.size());
    }
    progress.update(block + size);
  }
}

}  // namespace

EvaluationTable evaluate(const ViewDataset& dataset, const std::vector<EvaluationSet>& sets,
                         const std::vector<EvaluationPipeline>& pipelines, const EvaluationOptions& options,
                         Parallel& parallel, const Messages& messages, const std::string& task) {
  const std::vector<Selector>& selectors = sets.front().selectors;
  const std::size_t stride = pipelines.size() * selectors.size() * kMetrics.size();
  ProblemValues values{.columns = static_cast<Index>(stride),
                       .values = std::vector<double>(options.problems * stride),
                       .categories = {},
                       .first_category = {0}};
  Progress progress(messages, task, static_cast<Index>(options.problems));
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto first = static_cast<Index>(options.problems * s / sets.size()),
               last = static_cast<Index>(options.problems * (s + 1) / sets.size());
    solve(dataset, sets[s], pipelines, first, last, options, parallel, progress, values);
  }
  return table_of(values, pipelines, selectors, options, parallel);
}

}  // namespace svnet::train
