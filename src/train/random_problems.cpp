#include "train/random_problems.h"

#include <algorithm>

#include "base/error.h"

namespace svnet::train {

Index fewest_categories(const std::vector<bool>& excluded, const Config::Scores& config) {
  return std::min(config.min_categories, static_cast<Index>(std::count(excluded.begin(), excluded.end(), false)));
}

semantics::ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                                  const Config::Scores& config, const semantics::ViewWeights& weights) {
  std::vector<std::int64_t> category, object, pose, excluded_categories;
  for (const View& view : dataset.views) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
  }
  for (std::size_t c = 0; c < excluded.size(); ++c)
    if (excluded[c]) excluded_categories.push_back(static_cast<std::int64_t>(c));
  std::vector<Index> objects(dataset.categories.size(), 0);
  for (const auto& each : dataset.objects) ++objects[static_cast<std::size_t>(each.category)];
  for (std::size_t c = 0; c < objects.size(); ++c)
    check(excluded[c] || objects[c] >= config.min_objects, "category '", dataset.categories[c], "' has ", objects[c],
          " objects, fewer than min_objects, ", config.min_objects, "; lower it, or leave the category out");
  return {category, object, pose,
          semantics::ProblemOptions{.min_categories = fewest_categories(excluded, config),
                                    .max_categories = config.max_categories,
                                    .min_objects = config.min_objects,
                                    .max_objects = config.max_objects,
                                    .excluded_categories = excluded_categories,
                                    .view_weights = weights}};
}

}  // namespace svnet::train
