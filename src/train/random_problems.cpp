#include "train/random_problems.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::train {

Index fewest_categories(const std::vector<bool>& excluded, const Config::Scores& config) {
  return std::min(config.min_categories, static_cast<Index>(std::count(excluded.begin(), excluded.end(), false)));
}

namespace {

void check_objects(const ViewDataset& dataset, const std::vector<bool>& excluded, const Config::Scores& config) {
  std::vector<Index> objects(dataset.categories.size(), 0);
  for (const auto& each : dataset.objects) ++objects[static_cast<std::size_t>(each.category)];
  for (std::size_t c = 0; c < objects.size(); ++c)
    check(excluded[c] || objects[c] >= config.min_objects, "category '", dataset.categories[c], "' has ", objects[c],
          " objects, fewer than min_objects, ", config.min_objects, "; lower it, or leave the category out");
}

semantics::ProblemOptions problem_options(const Config::Scores& config, Index fewest) {
  return {.min_categories = fewest,
          .max_categories = config.max_categories,
          .min_objects = config.min_objects,
          .max_objects = config.max_objects};
}

/// Where the items of problems belong.
struct Items {
  std::vector<std::int64_t> category, object, pose;

  void add(const View& view) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
  }
};

}  // namespace

semantics::ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                                  const Config::Scores& config, const semantics::ViewWeights& weights) {
  check_objects(dataset, excluded, config);
  Items items;
  for (const View& view : dataset.views) items.add(view);
  semantics::ProblemOptions options = problem_options(config, fewest_categories(excluded, config));
  for (std::size_t c = 0; c < excluded.size(); ++c)
    if (excluded[c]) options.excluded_categories.push_back(static_cast<std::int64_t>(c));
  options.view_weights = weights;
  return {items.category, items.object, items.pose, options};
}

semantics::ClusteringProblems clustering_problems(const ViewDataset& dataset, const semantics::ViewSets& sets,
                                                  const Config::Scores& config) {
  Items items;
  std::vector<bool> excluded(dataset.categories.size(), true);
  for (Index i = 0; i < sets.count(); ++i) {
    const View& view = dataset.views[static_cast<std::size_t>(sets.set(i)[0])];
    items.add(view);
    excluded[static_cast<std::size_t>(view.category)] = false;
  }
  check_objects(dataset, excluded, config);
  return {items.category, items.object, items.pose, problem_options(config, fewest_categories(excluded, config))};
}

}  // namespace svnet::train
