#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "semantics/cluster_metrics.h"
#include "semantics/clusterer.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"

namespace svnet {

/// Chooses a view of each pose. `view` holds, per pose of the dataset, the number of the chosen view; empty means a
/// uniform one, drawn per problem.
struct Selector {
  std::string name;  // "top", "rand", "opt_glob", "opt_ind", "svnet"
  std::vector<std::int32_t> view;
};

Selector top_selector(const ViewDataset& dataset);
Selector random_selector();
/// The view of each pose with the highest score; the first among equals. Poses without any score get their top view.
Selector best_selector(std::string name, const ViewDataset& dataset, std::span<const double> scores);

/// Features of all views, clustered in one way.
struct EvaluationPipeline {
  std::string name;  // "mobilenet_v2_ward"
  const DistanceMatrix* distances;
  ClusteringOptions clustering;
};

struct Mean {
  double mean = 0;
  double standard_error = 0;  // NaN for a single problem
};

/// fm, nmi, purity.
constexpr std::array<const char*, 3> kMetricNames{"fm", "nmi", "purity"};

/// Means over the problems: cell [pipeline][selector][metric].
struct EvaluationTable {
  std::vector<std::string> pipelines, selectors;
  std::vector<std::vector<std::array<Mean, 3>>> cells;
  std::uint64_t problems = 0;
};

struct EvaluationOptions {
  std::uint64_t problems = 10000;
  std::uint64_t seed = 0;
  NmiAverage nmi = NmiAverage::arithmetic;
};

/// Solves the same random problems (objects and poses of Stream::evaluation, random views of Stream::selector) with
/// every selector's views and every pipeline. `problems` must be made of the dataset's views with its category, object
/// and pose numbers. The same bits for any number of threads.
EvaluationTable evaluate(const ViewDataset& dataset, const ClusteringProblems& problems,
                         const std::vector<EvaluationPipeline>& pipelines, const std::vector<Selector>& selectors,
                         const EvaluationOptions& options, Parallel& parallel, const Messages& messages,
                         const std::string& task);

}  // namespace svnet
