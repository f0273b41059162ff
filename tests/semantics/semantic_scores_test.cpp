#include "semantics/semantic_scores.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "semantics/allocations.h"
#include "semantics/exact_expectation.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

/// The uneven dataset, with features that a clustering groups correctly for some views and wrongly for others.
struct Fixture {
  SmallDataset dataset = SmallDataset::uneven();
  std::vector<float> features = clustered_features(dataset);
  DistanceMatrix distances = distances_of(features, 3);

  static std::vector<float> clustered_features(const SmallDataset& dataset) {
    RandomStream random(83, Stream::shuffle);
    std::vector<float> features;
    for (std::int64_t category : dataset.category)
      for (int d = 0; d < 3; ++d)
        features.push_back(static_cast<float>(1.5 * std::sin(1.7 * (category + d)) + random.normal()));
    return features;
  }

  ClusteringProblems problems(const ProblemOptions& options = {}) const {
    return {dataset.category, dataset.object, dataset.pose, options};
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void check_same(const SemanticScores& a, const SemanticScores& b) {
  CHECK(same_bits(a.individual, b.individual));
  CHECK(same_bits(a.global, b.global));
  CHECK(same_bits(a.standard_error, b.standard_error));
  CHECK(a.count == b.count);
  CHECK(a.problems == b.problems);
}

}  // namespace

TEST_CASE("Monte-Carlo scores are within four standard errors of the exact expectations") {
  const Fixture f;
  const auto problems = f.problems();
  const auto everything = all_problems(f.dataset, 3);
  for (Singletons singletons : {Singletons::zero, Singletons::skip}) {
    const ExactScores exact = exact_scores(f.distances, everything, singletons);
    const auto scores = semantic_scores(f.distances, problems,
                                        {.problems = 200000, .seed = 72, .singletons = singletons}, Parallel::shared());
    CHECK(scores.problems == 200000);
    for (Index v = 0; v < f.dataset.views(); ++v) {
      INFO("view " << v << (singletons == Singletons::skip ? ", skip" : ", zero"));
      const double count = static_cast<double>(scores.count[v]);
      CHECK(std::abs(count / 200000 - exact.inclusion[v]) <
            4 * std::sqrt(exact.inclusion[v] * (1 - exact.inclusion[v]) / 200000));
      // Scores are in [0, 1], so their standard deviation is at most 0.5.
      CHECK(std::abs(scores.global[v] - exact.global[v]) < 4 * 0.5 / std::sqrt(count));
      const bool alone = f.dataset.category[v] == 4;  // the only object of its category
      if (alone && singletons == Singletons::skip) {
        CHECK(std::isnan(scores.individual[v]));
        CHECK(std::isnan(exact.individual[v]));
        continue;
      }
      CHECK(std::abs(scores.individual[v] - exact.individual[v]) <= 4 * scores.standard_error[v]);
      CHECK(scores.standard_error[v] < 0.01);
      if (!alone) CHECK(scores.standard_error[v] > 1e-5);
    }
  }
}

TEST_CASE("standard errors cover the exact expectations as often as they should") {
  const Fixture f;
  const auto problems = f.problems();
  const ExactScores exact = exact_scores(f.distances, all_problems(f.dataset, 3), Singletons::zero);
  const int seeds = 200;
  std::vector<int> covered(f.dataset.views());
  for (int seed = 0; seed < seeds; ++seed) {
    const auto scores = semantic_scores(
        f.distances, problems, {.problems = 3000, .seed = 1000 + static_cast<std::uint64_t>(seed)}, Parallel::shared());
    for (Index v = 0; v < f.dataset.views(); ++v)
      covered[v] += std::abs(scores.individual[v] - exact.individual[v]) <= 1.96 * scores.standard_error[v];
  }
  for (Index v = 0; v < f.dataset.views(); ++v) {
    if (f.dataset.category[v] == 4) continue;  // always 0
    INFO("view " << v);
    REQUIRE(std::abs(exact.individual[v] - 0.5) < 0.45);  // otherwise the mean of few problems is not normal
    CHECK(covered[v] / static_cast<double>(seeds) >= 0.90);
    CHECK(covered[v] / static_cast<double>(seeds) <= 0.99);
  }
}

TEST_CASE("scores have the same bits for any number of threads") {
  const Fixture f;
  const auto problems = f.problems();
  for (auto method : {Clustering::ward, Clustering::kmeans})
    for (ScoreOptions options : {ScoreOptions{.problems = 5000}, ScoreOptions{.min_samples = 5000}}) {
      options.seed = 73;
      options.clustering = {.method = method, .kmeans = {.n_init = 2}, .dimension = 3};
      Parallel one(1);
      const auto expected = semantic_scores(f.distances, problems, options, one);
      for (int threads : {2, 8}) {
        Parallel pool(threads);
        check_same(semantic_scores(f.distances, problems, options, pool), expected);
      }
    }
}

TEST_CASE("scores by weights have the same bits for any number of threads") {
  const Fixture f;
  ViewWeights weights;
  for (Index v = 0; v < f.dataset.views(); ++v) weights.push_back(static_cast<double>(1 + v % 3));
  const auto problems = f.problems({.view_weights = weights});
  for (const ScoreOptions& options :
       {ScoreOptions{.problems = 5000, .seed = 75}, ScoreOptions{.min_samples = 3000, .seed = 75}}) {
    Parallel one(1), three(3);
    const auto expected = semantic_scores(f.distances, problems, options, one);
    check_same(semantic_scores(f.distances, problems, options, three), expected);
  }
}

TEST_CASE("scores by weights are the expectations over problems by weights") {
  const Fixture f;
  ViewWeights weights;
  for (Index v = 0; v < f.dataset.views(); ++v) weights.push_back(v % 3 == 0 ? 0.05 : 1);
  const auto problems = f.problems({.view_weights = weights});
  auto everything = all_problems(f.dataset, 3);
  for (auto& problem : everything)
    for (auto row : problem.rows) {
      const auto views = problems.views_of_pose(problems.pose_of_view()[row]);
      double sum = 0;
      for (auto v : views) sum += weights[v];
      problem.probability *= weights[row] / sum * static_cast<double>(views.size());
    }
  const ExactScores exact = exact_scores(f.distances, everything, Singletons::zero);
  const auto scores = semantic_scores(f.distances, problems, {.problems = 200000, .seed = 76}, Parallel::shared());
  for (Index v = 0; v < f.dataset.views(); ++v) {
    INFO("view " << v);
    CHECK(std::abs(scores.individual[v] - exact.individual[v]) <= 4 * scores.standard_error[v]);
    CHECK(problems.inclusion_probability(v) == Approx(exact.inclusion[v]).epsilon(1e-6));
  }
}

TEST_CASE("the stop rules leave out views that cannot be drawn") {
  const Fixture f;
  ViewWeights weights(f.dataset.views(), 1.0);
  Index never = 0;  // a view that is not the only one of its pose
  while (f.problems().views_of_pose(f.problems().pose_of_view()[never]).size() < 2) ++never;
  weights[never] = 0;
  const auto problems = f.problems({.view_weights = weights});
  for (const ScoreOptions& options :
       {ScoreOptions{.min_samples = 3000, .seed = 77}, ScoreOptions{.target_error = 0.01, .seed = 77}}) {
    const auto scores = semantic_scores(f.distances, problems, options, Parallel::shared());
    for (Index v = 0; v < f.dataset.views(); ++v) {
      INFO("view " << v);
      CHECK((scores.count[v] == 0) == (v == never));
      CHECK(std::isnan(scores.individual[v]) == (v == never));
      if (v != never) CHECK(scores.count[v] >= std::max<std::uint64_t>(options.min_samples, 100));
    }
  }
}

TEST_CASE("scores stop once every view has its samples, at the end of a block") {
  const Fixture f;
  const auto problems = f.problems({.excluded_categories = {4}});
  const auto scores = semantic_scores(f.distances, problems, {.min_samples = 20000, .seed = 74}, Parallel::shared());
  CHECK(scores.problems % 16384 == 0);
  std::uint64_t fewest = scores.problems;
  for (Index v = 0; v < f.dataset.views(); ++v) {
    if (f.dataset.category[v] == 4) {
      CHECK(scores.count[v] == 0);
      CHECK(std::isnan(scores.individual[v]));
      CHECK(std::isnan(scores.global[v]));
      CHECK(std::isnan(scores.standard_error[v]));
    } else {
      fewest = std::min(fewest, scores.count[v]);
    }
  }
  CHECK(fewest >= 20000);
  // One block earlier there are too few.
  const auto before =
      semantic_scores(f.distances, problems, {.problems = scores.problems - 16384, .seed = 74}, Parallel::shared());
  for (Index v = 0; v < f.dataset.views(); ++v)
    if (before.count[v] > 0) fewest = std::min(fewest, before.count[v]);
  CHECK(fewest < 20000);
}

TEST_CASE("scores stop at the target error") {
  const Fixture f;
  const auto problems = f.problems();
  for (Singletons singletons : {Singletons::zero, Singletons::skip}) {
    const auto scores = semantic_scores(
        f.distances, problems, {.target_error = 0.003, .seed = 75, .singletons = singletons}, Parallel::shared());
    CHECK(scores.problems > 16384);
    for (double error : scores.standard_error) CHECK_FALSE(error > 0.003);
  }
  const auto capped =
      semantic_scores(f.distances, problems, {.problems = 100, .target_error = 1e-9, .seed = 75}, Parallel::shared());
  CHECK(capped.problems == 100);
}

TEST_CASE("scores continue from saved sums, and ranges of problems add up") {
  const Fixture f;
  const auto problems = f.problems();
  Parallel pool(2);
  ScoreSums whole(problems.views());
  SingleProcess single_process;
  std::vector<ScoreSums> snapshots;
  continue_scores(f.distances, problems, {.problems = 40000, .seed = 76}, pool, single_process, whole,
                  {.after_step = [&](const ScoreSums& sums) { snapshots.push_back(sums); }});
  REQUIRE(snapshots.size() >= 3);
  CHECK(snapshots[0].problems < 16384);
  CHECK(snapshots.back() == whole);
  ScoreSums resumed;
  for (const std::size_t stopped : {std::size_t{0}, snapshots.size() / 2}) {
    resumed = snapshots[stopped];
    continue_scores(f.distances, problems, {.problems = 40000, .seed = 76}, pool, single_process, resumed);
    CHECK(resumed == whole);
  }

  // The rules are not checked inside a block.
  continue_scores(f.distances, problems, {.min_samples = 1, .seed = 76}, pool, single_process, resumed);
  CHECK(resumed.problems == 49152);

  ProblemSolver solver(f.distances, problems, ProblemScoring{.seed = 76}, pool);
  ScoreSums last(problems.views()), first(problems.views());
  solver.solve(10007, 40000, last);
  solver.solve(0, 10007, first);
  first.add_and_clear(last);
  CHECK(first == whole);
}

TEST_CASE("another seed or clustering gives other scores") {
  const Fixture f;
  const auto problems = f.problems();
  const auto individual = [&](const ScoreOptions& options) {
    return semantic_scores(f.distances, problems, options, Parallel::shared()).individual;
  };
  const auto ward = individual({.problems = 2000, .seed = 77});
  CHECK(individual({.problems = 2000, .seed = 77}) == ward);
  CHECK(individual({.problems = 2000, .seed = 78}) != ward);
  CHECK(individual({.problems = 2000, .seed = 77, .clustering = {.method = Clustering::single}}) != ward);
  const auto kmeans =
      individual({.problems = 2000, .seed = 77, .clustering = {.method = Clustering::kmeans, .dimension = 3}});
  CHECK(kmeans != ward);
}

TEST_CASE("solving problems allocates nothing per problem") {
  const Fixture f;
  const auto problems = f.problems();
  Parallel one(1);
  for (auto method : {Clustering::ward, Clustering::kmeans}) {
    ProblemSolver solver(f.distances, problems, ProblemScoring{.clustering = {.method = method}}, one);
    ScoreSums sums(problems.views());
    const auto cost = [&](std::uint64_t count) {
      const std::size_t before = allocations();
      solver.solve(0, count, sums);
      return allocations() - before;
    };
    CHECK(cost(10) == cost(5000));
  }
}

TEST_CASE("progress reports how many problems are solved") {
  const Fixture f;
  Index last_done = 0, last_total = 0;
  const Messages messages{.line = {}, .progress = [&](std::string_view task, Index done, Index total, double) {
                            CHECK(task == "semantic scores");
                            CHECK(done >= last_done);
                            last_done = done;
                            last_total = total;
                          }};
  semantic_scores(f.distances, f.problems(), {.problems = 30000}, Parallel::shared(), messages);
  CHECK(last_done == 30000);
  CHECK(last_total == 30000);
  // With few samples, the expected number of problems is sometimes too small.
  Index ends = 0;
  const Messages counting{
      .line = {}, .progress = [&](std::string_view, Index done, Index total, double) { ends += done >= total; }};
  semantic_scores(f.distances, f.problems(), {.min_samples = 20000, .seed = 3}, Parallel::shared(), counting);
  CHECK(ends <= 1);
}

TEST_CASE("scores refuse options that cannot be fulfilled") {
  const Fixture f;
  const auto problems = f.problems();
  const auto scores = [&](const ScoreOptions& options) {
    return semantic_scores(f.distances, problems, options, Parallel::shared());
  };
  CHECK_THROWS_WITH(scores({}), "[scores] nothing says when to stop; give problems, min_samples or target_error");
  CHECK_THROWS_WITH(scores({.problems = (std::uint64_t{1} << 32) + 1}),
                    "[scores] problems is 4294967297; the sums hold 4294967296 problems");
  CHECK_THROWS_WITH(scores({.min_samples = std::uint64_t{1} << 40}), Catch::Contains("min_samples is 1099511627776"));
  CHECK_THROWS_WITH(scores({.problems = 1, .target_error = -0.5}),
                    "[scores] target_error is -0.5; it must not be negative");
  const DistanceMatrix other(3);
  CHECK_THROWS_WITH(semantic_scores(other, problems, {.problems = 1}, Parallel::shared()),
                    "[scores] distances of 3 views, but problems of 17");
  ScoreSums wrong(2);
  SingleProcess single_process;
  CHECK_THROWS_WITH(continue_scores(f.distances, problems, {.problems = 1}, Parallel::shared(), single_process, wrong),
                    "[scores] the sums so far are of 2 views, the problems of 17");
  CHECK_THROWS_WITH(scores({.problems = 1, .clustering = {.method = Clustering::kmeans, .dimension = 0}}),
                    "[kmeans] the features have dimension 0; at least 1 is needed");
}
