#include "semantics/clustering_problems.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "semantics/allocations.h"
#include "semantics/exact_expectation.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

ClusteringProblems problems_of(const SmallDataset& dataset, const ProblemOptions& options = {}) {
  return {dataset.category, dataset.object, dataset.pose, options};
}

/// `categories` categories of `objects` objects of 2 poses of 3 views.
SmallDataset regular(Index categories, Index objects) {
  SmallDataset dataset;
  for (Index c = 0; c < categories; ++c)
    for (Index o = 0; o < objects; ++o)
      for (Index p = 0; p < 2; ++p) dataset.add(c, o, p, 3);
  return dataset;
}

/// The standard score of a chi-square statistic of counts that should be in proportion to the probabilities; those
/// expected less than 10 times are merged.
double chi_square_score(const std::vector<double>& probabilities, const std::vector<double>& counts, double draws) {
  double statistic = 0, cells = 0, rare_expected = 0, rare_counted = 0;
  const auto add = [&](double expected, double counted) {
    statistic += (counted - expected) * (counted - expected) / expected;
    ++cells;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = probabilities[i] * draws;
    if (expected >= 10) {
      add(expected, counts[i]);
    } else {
      rare_expected += expected;
      rare_counted += counts[i];
    }
  }
  if (rare_expected > 0) add(rare_expected, rare_counted);
  return (statistic - (cells - 1)) / std::sqrt(2 * (cells - 1));
}

/// Counts a problem that was drawn; `number` has the place in `counts` of every problem that can be drawn, by its
/// sorted rows.
void count(const ClusteringProblem& problem, const std::map<std::vector<std::int32_t>, std::size_t>& number,
           std::vector<double>& counts) {
  auto rows = problem.rows;
  std::sort(rows.begin(), rows.end());
  const auto found = number.find(rows);
  REQUIRE(found != number.end());
  ++counts[found->second];
}

}  // namespace

TEST_CASE("every problem is drawn with its exact probability") {
  const auto dataset = SmallDataset::uneven();
  const auto expected = all_problems(dataset, 3);
  REQUIRE(expected.size() == 6644);
  std::map<std::vector<std::int32_t>, std::size_t> number;
  std::vector<double> probabilities;
  double total = 0;
  for (const auto& problem : expected) {
    auto rows = problem.rows;
    std::sort(rows.begin(), rows.end());
    REQUIRE(number.emplace(rows, number.size()).second);
    probabilities.push_back(problem.probability);
    total += problem.probability;
  }
  CHECK(total == Approx(1).epsilon(1e-12));

  const auto problems = problems_of(dataset);
  auto problem = problems.new_problem();
  std::vector<double> counts(expected.size());
  const int draws = 500000;
  for (int i = 0; i < draws; ++i) {
    problems.draw(51, i, problem);
    count(problem, number, counts);
  }
  CHECK(std::abs(chi_square_score(probabilities, counts, draws)) < 4);
}

TEST_CASE("the probability that a problem contains a view is exact") {
  const auto dataset = SmallDataset::uneven();
  const auto problems = problems_of(dataset);
  std::vector<double> inclusion(dataset.views());
  for (const auto& problem : all_problems(dataset, 3))
    for (auto row : problem.rows) inclusion[row] += problem.probability;
  for (Index v = 0; v < dataset.views(); ++v)
    CHECK(problems.inclusion_probability(v) == Approx(inclusion[v]).epsilon(1e-12));
}

TEST_CASE("a problem has distinct objects with one view each, labelled by category in order of first appearance") {
  const auto dataset = regular(6, 4);
  const auto problems = problems_of(dataset);
  CHECK(problems.max_items() == 24);
  CHECK(problems.max_categories() == 6);
  CHECK(problems.poses() == 48);
  CHECK(problems.views() == 144);
  auto problem = problems.new_problem();
  for (int i = 0; i < 500; ++i) {
    problems.draw(52, i, problem);
    const std::size_t items = problem.rows.size();
    REQUIRE(problem.poses.size() == items);
    REQUIRE(problem.labels.size() == items);
    std::set<std::pair<std::int64_t, std::int64_t>> objects;
    std::map<std::int64_t, std::int32_t> label_of_category;
    for (std::size_t k = 0; k < items; ++k) {
      const auto row = problem.rows[k];
      REQUIRE(objects.emplace(dataset.category[row], dataset.object[row]).second);
      REQUIRE(problems.pose_of_view()[row] == problem.poses[k]);
      const auto next = static_cast<std::int32_t>(label_of_category.size());
      REQUIRE(label_of_category.try_emplace(dataset.category[row], next).first->second == problem.labels[k]);
    }
    REQUIRE(static_cast<Index>(label_of_category.size()) == problem.categories);
    REQUIRE(problem.categories >= 3);
  }
}

TEST_CASE("options limit the number of categories and objects, and exclude categories") {
  const auto dataset = regular(6, 4);
  const auto problems = problems_of(
      dataset,
      {.min_categories = 2, .max_categories = 4, .min_objects = 2, .max_objects = 3, .excluded_categories = {1, 5}});
  CHECK(problems.max_items() == 12);
  auto problem = problems.new_problem();
  std::set<Index> categories, objects;
  for (int i = 0; i < 300; ++i) {
    problems.draw(53, i, problem);
    categories.insert(problem.categories);
    for (std::int32_t label = 0; label < problem.categories; ++label)
      objects.insert(std::count(problem.labels.begin(), problem.labels.end(), label));
    for (auto row : problem.rows) {
      REQUIRE(dataset.category[row] != 1);
      REQUIRE(dataset.category[row] != 5);
    }
  }
  CHECK(categories == std::set<Index>{2, 3, 4});
  CHECK(objects == std::set<Index>{2, 3});
  for (Index v = 0; v < dataset.views(); ++v) {
    const bool excluded = dataset.category[v] == 1 || dataset.category[v] == 5;
    CHECK((problems.inclusion_probability(v) == 0) == excluded);
    CHECK(problems.may_have_partner(v) == !excluded);
  }
}

TEST_CASE("three categories suffice for problems of three") {
  const auto problems = problems_of(regular(3, 2), {.min_categories = 3, .max_categories = 3});
  auto problem = problems.new_problem();
  for (int i = 0; i < 20; ++i) {
    problems.draw(54, i, problem);
    CHECK(problem.categories == 3);
  }
  CHECK_FALSE(problems_of(regular(3, 1)).may_have_partner(0));
}

TEST_CASE("seed and index determine a problem, and poses can be drawn without views") {
  const auto dataset = regular(5, 3);
  const auto problems = problems_of(dataset);
  auto once = problems.new_problem(), again = problems.new_problem();
  problems.draw(55, 1234567890123, once);
  problems.draw(56, 1, again);
  problems.draw(55, 7, again);
  CHECK(again.rows != once.rows);
  problems.draw(55, 1234567890123, again);
  CHECK(again.rows == once.rows);
  CHECK(again.labels == once.labels);

  RandomStream random(55, Stream::problem, 1234567890123);
  problems.draw_poses(random, again);
  CHECK(again.poses == once.poses);
  CHECK(again.labels == once.labels);
  CHECK(again.rows.empty());
  for (std::size_t i = 0; i < once.poses.size(); ++i) {
    const auto views = problems.views_of_pose(once.poses[i]);
    CHECK(views.size() == 3);
    CHECK(std::find(views.begin(), views.end(), once.rows[i]) != views.end());
  }
}

TEST_CASE("views may be in any order, and labels are only compared") {
  const auto dataset = SmallDataset::uneven();
  SmallDataset reversed = dataset;
  for (auto* numbers : {&reversed.category, &reversed.object, &reversed.pose})
    std::reverse(numbers->begin(), numbers->end());
  const auto problems = problems_of(dataset), of_reversed = problems_of(reversed);
  REQUIRE(problems.poses() == of_reversed.poses());
  for (Index v = 0; v < dataset.views(); ++v) {
    CHECK(problems.pose_of_view()[v] == of_reversed.pose_of_view()[dataset.views() - 1 - v]);
    const auto views = problems.views_of_pose(problems.pose_of_view()[v]);
    CHECK(std::is_sorted(views.begin(), views.end()));
    CHECK(std::find(views.begin(), views.end(), v) != views.end());
  }
}

TEST_CASE("views are drawn in proportion to their weights, and poses as without weights") {
  const auto dataset = SmallDataset::uneven();
  const auto uniform = problems_of(dataset);
  RandomStream random(58, Stream::shuffle);
  ViewWeights weights;
  for (Index v = 0; v < dataset.views(); ++v) {
    const auto views = uniform.views_of_pose(uniform.pose_of_view()[v]);
    weights.push_back(views.size() > 1 && v == views.back() ? 0 : 1e308 * random.uniform());  // a sum may overflow
  }
  const auto weighted = problems_of(dataset, {.view_weights = weights});
  // The exact probabilities: those of the uniform problems, times how much likelier the weights make each view.
  std::vector<double> gain(dataset.views());
  for (Index p = 0; p < weighted.poses(); ++p) {
    const auto views = weighted.views_of_pose(p);
    double sum = 0;
    for (auto v : views) sum += weights[v] / 1e308;
    for (auto v : views) gain[v] = weights[v] / 1e308 / sum * static_cast<double>(views.size());
  }
  std::map<std::vector<std::int32_t>, std::size_t> number;
  std::vector<double> probabilities, inclusion(dataset.views());
  for (const auto& problem : all_problems(dataset, 3)) {
    double probability = problem.probability;
    for (auto row : problem.rows) probability *= gain[row];
    for (auto row : problem.rows) inclusion[row] += probability;
    if (probability == 0) continue;
    auto rows = problem.rows;
    std::sort(rows.begin(), rows.end());
    number.emplace(rows, number.size());
    probabilities.push_back(probability);
  }
  for (Index v = 0; v < dataset.views(); ++v) {
    CHECK(weighted.inclusion_probability(v) == Approx(inclusion[v]).epsilon(1e-6));
    CHECK((weighted.inclusion_probability(v) == 0) == (weights[v] == 0));
  }

  auto problem = weighted.new_problem(), same_poses = uniform.new_problem();
  std::vector<double> counts(probabilities.size());
  const int draws = 500000;
  for (int i = 0; i < draws; ++i) {
    weighted.draw(59, i, problem);
    if (i < 100) {
      uniform.draw(59, i, same_poses);
      REQUIRE(problem.poses == same_poses.poses);
    }
    count(problem, number, counts);
  }
  CHECK(std::abs(chi_square_score(probabilities, counts, draws)) < 4);
}

TEST_CASE("equal weights draw as no weights do") {
  const auto dataset = regular(4, 3);
  const auto equal = problems_of(dataset, {.view_weights = ViewWeights(dataset.views(), 0.3)}),
             uniform = problems_of(dataset);
  auto problem = equal.new_problem();
  std::vector<double> counts(dataset.views()), probabilities;
  double items = 0;
  for (int i = 0; i < 100000; ++i) {
    equal.draw(60, i, problem);
    items += static_cast<double>(problem.rows.size());
    for (auto row : problem.rows) ++counts[row];
  }
  double sum = 0;
  for (Index v = 0; v < dataset.views(); ++v) sum += uniform.inclusion_probability(v);
  for (Index v = 0; v < dataset.views(); ++v) {
    CHECK(equal.inclusion_probability(v) == Approx(uniform.inclusion_probability(v)).epsilon(1e-8));
    probabilities.push_back(uniform.inclusion_probability(v) / sum);
  }
  CHECK(std::abs(chi_square_score(probabilities, counts, items)) < 4);
}

TEST_CASE("weights of excluded categories are ignored") {
  const auto dataset = regular(4, 2);
  ViewWeights weights(dataset.views(), 1.0);
  for (Index v = 0; v < dataset.views(); ++v)
    if (dataset.category[v] == 2) weights[v] = 0;
  const auto problems = problems_of(dataset, {.excluded_categories = {2}, .view_weights = weights});
  for (Index v = 0; v < dataset.views(); ++v)
    CHECK((problems.inclusion_probability(v) == 0) == (dataset.category[v] == 2));
  CHECK_THROWS_WITH(problems_of(dataset, {.view_weights = weights}),
                    "[problems] all views of a pose have weight 0, view 24 among them; one must be above 0, or exclude "
                    "the category 2");
}

TEST_CASE("problems refuse weights that are no probabilities") {
  const auto dataset = regular(3, 2);
  ViewWeights weights(dataset.views(), 1.0);
  weights.pop_back();
  CHECK_THROWS_WITH(problems_of(dataset, {.view_weights = weights}), "[problems] 35 weights of 36 views");
  weights.push_back(-1);
  CHECK_THROWS_WITH(problems_of(dataset, {.view_weights = weights}),
                    "[problems] the weight of view 35 is -1; weights must be 0 or more");
  weights.back() = std::nan("");
  CHECK_THROWS_WITH(problems_of(dataset, {.view_weights = weights}),
                    "[problems] the weight of view 35 is nan; weights must be 0 or more");
}

TEST_CASE("drawing allocates nothing") {
  const auto dataset = regular(8, 5);
  const auto problems =
      problems_of(dataset, {.view_weights = GENERATE_COPY(ViewWeights{}, ViewWeights(dataset.views(), 1.0))});
  auto problem = problems.new_problem();
  const std::size_t before = allocations();
  for (int i = 0; i < 2000; ++i) problems.draw(57, i, problem);
  CHECK(allocations() == before);
}

TEST_CASE("problems refuse options that cannot be drawn") {
  const auto five = regular(5, 4);
  CHECK_THROWS_WITH(
      problems_of(five, {.excluded_categories = {0, 1, 4}}),
      "[problems] 2 of 5 categories are left after excluding, min_categories is 3; exclude fewer or lower "
      "min_categories");
  CHECK_THROWS_WITH(problems_of(five, {.excluded_categories = {9}}), "[problems] excluded category 9 has no views");
  CHECK_THROWS_WITH(problems_of(five, {.min_categories = 4, .max_categories = 3}),
                    "[problems] min_categories 4 is above max_categories 3");
  CHECK_THROWS_WITH(problems_of(five, {.min_objects = 3, .max_objects = 2}),
                    "[problems] min_objects 3 is above max_objects 2");
  CHECK_THROWS_WITH(problems_of(five, {.min_objects = 5}),
                    "[problems] category 0 has 4 objects, min_objects is 5; exclude it or lower min_objects");
  CHECK_THROWS_WITH(
      problems_of(five, {.min_categories = 0}),
      "[problems] categories from 0 to 0 and objects from 1 to 0; the least must be 1 or more, the most 0 "
      "(all) or more");
  CHECK_THROWS_WITH(problems_of(SmallDataset{}), "[problems] there are no views");
  SmallDataset broken = five;
  broken.pose.pop_back();
  CHECK_THROWS_WITH(problems_of(broken),
                    "[problems] 120 categories, 120 objects and 119 poses; one of each per view is needed");
}
