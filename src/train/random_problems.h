#pragma once
#include <vector>

#include "data/view_dataset.h"
#include "semantics/clustering_problems.h"
#include "semantics/view_sets.h"
#include "train/config/config.h"

namespace svnet::train {

/// The fewest categories in a problem: scores.min_categories, or all that are not excluded if those are fewer.
Index fewest_categories(const std::vector<bool>& excluded, const Config::Scores& config);

/// The random problems of a configuration over the categories of a dataset that are not excluded. Views are drawn by
/// `weights`, uniformly if it is empty. Throws Error if a category has too few objects.
semantics::ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                                  const Config::Scores& config,
                                                  const semantics::ViewWeights& weights = {});

/// The random problems of sets of views of the same poses, which are uniform. Throws Error as above.
semantics::ClusteringProblems clustering_problems(const ViewDataset& dataset, const semantics::ViewSets& sets,
                                                  const Config::Scores& config);

}  // namespace svnet::train
