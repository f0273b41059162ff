#include "semantics/exact_expectation.h"

#include <cmath>
#include <map>

#include "semantics/agglomerative.h"

using namespace svnet;
using namespace svnet::semantics;

void SmallDataset::add(std::int64_t of_category, std::int64_t of_object, std::int64_t of_pose, Index views) {
  category.insert(category.end(), views, of_category);
  object.insert(object.end(), views, of_object);
  pose.insert(pose.end(), views, of_pose);
}

SmallDataset SmallDataset::uneven() {
  SmallDataset dataset;
  dataset.add(10, 1, 1, 2);
  dataset.add(10, 2, 1, 2);
  dataset.add(-3, 1, 1, 2);
  dataset.add(-3, 1, 2, 2);
  dataset.add(-3, 7, 5, 1);
  dataset.add(20, 1, 1, 2);
  dataset.add(20, 2, 1, 1);
  dataset.add(20, 2, 9, 1);
  dataset.add(20, 3, 1, 2);
  dataset.add(4, 1, 1, 2);
  return dataset;
}

namespace {

/// One choice for a part of a problem.
struct Choice {
  std::vector<std::int32_t> rows;
  double probability;
};

double binomial(std::size_t n, std::size_t k) {
  return std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1));
}

using ViewsByPose = std::map<std::int64_t, std::vector<std::int32_t>>;
using PosesByObject = std::map<std::int64_t, ViewsByPose>;

std::vector<Choice> choices_of_object(const ViewsByPose& poses) {
  std::vector<Choice> choices;
  for (const auto& [pose, views] : poses)
    for (std::int32_t view : views) choices.push_back({{view}, 1 / static_cast<double>(poses.size() * views.size())});
  return choices;
}

std::vector<Choice> products(const std::vector<Choice>& left, const std::vector<Choice>& right) {
  std::vector<Choice> all;
  for (const auto& l : left)
    for (const auto& r : right) {
      auto rows = l.rows;
      rows.insert(rows.end(), r.rows.begin(), r.rows.end());
      all.push_back({rows, l.probability * r.probability});
    }
  return all;
}

std::vector<Choice> choices_of_category(const PosesByObject& by_object) {
  std::vector<ViewsByPose> objects;
  for (const auto& [object, poses] : by_object) objects.push_back(poses);
  std::vector<Choice> choices;
  for (unsigned chosen = 1; chosen < 1u << objects.size(); ++chosen) {
    const auto count = static_cast<std::size_t>(__builtin_popcount(chosen));
    const double probability = 1 / (static_cast<double>(objects.size()) * binomial(objects.size(), count));
    std::vector<Choice> some{{{}, probability}};
    for (std::size_t o = 0; o < objects.size(); ++o)
      if (chosen >> o & 1u) some = products(some, choices_of_object(objects[o]));
    choices.insert(choices.end(), some.begin(), some.end());
  }
  return choices;
}

}  // namespace

std::vector<WeightedProblem> all_problems(const SmallDataset& dataset, Index min_categories) {
  std::map<std::int64_t, PosesByObject> by_category;
  for (Index v = 0; v < dataset.views(); ++v)
    by_category[dataset.category[v]][dataset.object[v]][dataset.pose[v]].push_back(static_cast<std::int32_t>(v));
  std::vector<std::vector<Choice>> categories;
  for (const auto& [category, objects] : by_category) categories.push_back(choices_of_category(objects));

  const std::size_t all = categories.size();
  std::vector<WeightedProblem> problems;
  for (unsigned chosen = 1; chosen < 1u << all; ++chosen) {
    const auto count = static_cast<std::size_t>(__builtin_popcount(chosen));
    if (static_cast<Index>(count) < min_categories) continue;
    const double numbers = static_cast<double>(all) - static_cast<double>(min_categories) + 1;
    std::vector<Choice> some{{{}, 1 / (numbers * binomial(all, count))}};
    for (std::size_t c = 0; c < all; ++c)
      if (chosen >> c & 1u) some = products(some, categories[c]);
    for (const auto& choice : some) {
      std::map<std::int64_t, std::int32_t> number;  // of the categories, ascending
      for (auto row : choice.rows) number.try_emplace(dataset.category[row], static_cast<std::int32_t>(number.size()));
      std::vector<std::int32_t> labels;
      for (auto row : choice.rows) labels.push_back(number[dataset.category[row]]);
      problems.push_back({choice.rows, labels, choice.probability});
    }
  }
  return problems;
}

ExactScores exact_scores(const DistanceMatrix& distances, const std::vector<WeightedProblem>& problems,
                         Singletons singletons) {
  const auto views = static_cast<std::size_t>(distances.size());
  ExactScores exact{std::vector<double>(views), std::vector<double>(views), std::vector<double>(views)};
  std::vector<double> individual_weight(views);
  for (const auto& problem : problems) {
    const std::size_t n = problem.rows.size();
    std::vector<std::int32_t> labels(n);
    Agglomerative(Linkage::ward, static_cast<Index>(n))
        .cluster(distances, problem.rows, problem.labels.back() + 1, labels);
    const std::vector<std::int64_t> truth(problem.labels.begin(), problem.labels.end());
    const std::vector<std::int64_t> predicted(labels.begin(), labels.end());
    const auto individual = fowlkes_mallows_individual(truth, predicted, singletons);
    const double global = fowlkes_mallows(truth, predicted);
    for (std::size_t i = 0; i < n; ++i) {
      const auto view = static_cast<std::size_t>(problem.rows[i]);
      exact.inclusion[view] += problem.probability;
      exact.global[view] += problem.probability * global;
      if (std::isnan(individual[i])) continue;
      exact.individual[view] += problem.probability * individual[i];
      individual_weight[view] += problem.probability;
    }
  }
  for (std::size_t v = 0; v < views; ++v) {
    exact.individual[v] /= individual_weight[v];
    exact.global[v] /= exact.inclusion[v];
  }
  return exact;
}
