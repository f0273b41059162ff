#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "data/view_dataset.h"
#include "semantics/clusterer.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"
#include "semantics/view_sets.h"
#include "train/category_bootstrap.h"
#include "train/metrics.h"
#include "train/selectors.h"

namespace svnet::train {

/// One way to cluster views: by the distances of their features, and by an algorithm.
struct EvaluationPipeline {
  std::string name;  // "mobilenet_v2_ward"
  const semantics::DistanceMatrix* distances;
  semantics::ClusteringOptions clustering;
};

struct Mean {
  double mean = 0;
  double standard_error = 0;  ///< over problems; NaN for a single one
  Interval interval{};        ///< over categories (category_bootstrap.h)
};

/// A selector minus another one, in the same problems.
struct Difference {
  double mean = 0;
  Interval interval;  ///< over categories (category_bootstrap.h)
};

/// Means over the problems: cell [pipeline][selector][metric].
struct EvaluationTable {
  std::vector<std::string> pipelines, selectors;
  std::vector<std::vector<PerMetric<Mean>>> cells;
  /// By the name of the selector to compare with, [pipeline][selector][metric]. If there are several pipelines, their
  /// mean is one row more at the end.
  std::map<std::string, std::vector<std::vector<PerMetric<Difference>>>> differences{};
  std::uint64_t problems = 0;
};

struct EvaluationOptions {
  std::uint64_t problems = 10000;
  std::uint64_t seed = 0;
  semantics::NmiAverage nmi = semantics::NmiAverage::arithmetic;
  semantics::Fusion fusion = semantics::Fusion::mean;  ///< of the views of an object, if there are several
  /// Selectors to compare with, if the table has them.
  std::vector<std::string> baselines{"top", "rand", "broadside", "phi_map"};
};

/// Random problems, and the selectors that choose their views.
struct EvaluationSet {
  semantics::ClusteringProblems problems;
  std::vector<Selector> selectors;
};

/// Solves the same random problems (objects and poses of Stream::evaluation, random views of Stream::selector) with
/// the views of every selector and with every pipeline. About as many problems are of each set. Requires: all sets have
/// the same names of selectors, and their problems are of the dataset's views, with its indices of categories, objects
/// and poses. The result has the same bits for any number of threads.
EvaluationTable evaluate(const ViewDataset& dataset, const std::vector<EvaluationSet>& sets,
                         const std::vector<EvaluationPipeline>& pipelines, const EvaluationOptions& options,
                         Parallel& parallel, const Messages& messages, const std::string& task);

}  // namespace svnet::train
