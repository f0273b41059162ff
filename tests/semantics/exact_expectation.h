#pragma once
#include <functional>
#include <vector>

#include "semantics/cluster_metrics.h"
#include "semantics/clustering_problems.h"
#include "semantics/distances.h"

/// A dataset that is small enough to enumerate all its clustering problems.
struct SmallDataset {
  std::vector<std::int64_t> category, object, pose;  // per view

  /// Adds a pose of an object with `views` views.
  void add(std::int64_t of_category, std::int64_t of_object, std::int64_t of_pose, svnet::Index views);
  svnet::Index views() const { return static_cast<svnet::Index>(category.size()); }

  /// Four categories of 2, 2, 3 and 1 objects, with uneven numbers of poses and views. It has 6644 problems of 3 or 4
  /// categories.
  static SmallDataset uneven();
};

struct WeightedProblem {
  std::vector<std::int32_t> rows, labels;  // labels by category, ascending
  double probability;
};

/// Every problem of PAPER.md section 4 with its probability, from min_categories to all, 1 to all objects of each.
std::vector<WeightedProblem> all_problems(const SmallDataset& dataset, svnet::Index min_categories);

struct ExactScores {
  std::vector<double> individual, global, inclusion;  // per view; inclusion: probability that a problem contains it
};

/// The expected score of each view over the problems that contain it; Ward linkage.
ExactScores exact_scores(const svnet::semantics::DistanceMatrix& distances,
                         const std::vector<WeightedProblem>& problems, svnet::semantics::Singletons singletons);
