#include "semantics/problem_batch.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "semantics/allocations.h"
#include "semantics/exact_expectation.h"
#include "semantics/pair_scores.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

/// Views of one pose each, not sorted by category.
struct Scattered {
  std::vector<std::int64_t> category, object, pose;
  DistanceMatrix distances;

  Scattered(Index views, Index categories, Index objects)
      : distances(distances_of(random_points(views, 4, categories, 61), 4)) {
    for (Index v = 0; v < views; ++v) {
      category.push_back(v * 7 % categories);
      object.push_back(v / categories % objects);
      pose.push_back(0);
    }
  }
};

}  // namespace

TEST_CASE("a batch has the problems that are drawn one by one, in ascending order, with their distances") {
  const Scattered views(2000, 20, 6);
  const ClusteringProblems problems(views.category, views.object, views.pose);
  auto problem = problems.new_problem();
  for (const int threads : {1, 3}) {
    Parallel pool(threads);
    ProblemBatch batch(views.distances, problems, pool);
    for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 33}) {
      const std::uint64_t drawn = batch.draw(62, first, 1500);
      REQUIRE(drawn == 1500);
      for (std::uint64_t p = 0; p < drawn; ++p) {
        problems.draw(62, first + p, problem);
        const auto by_place = [&](std::int32_t a, std::int32_t b) {
          return problems.place_of_view(a) < problems.place_of_view(b);
        };
        std::sort(problem.rows.begin(), problem.rows.end(), by_place);
        const auto rows = batch.items(static_cast<Index>(p));
        REQUIRE(std::vector(rows.begin(), rows.end()) == problem.rows);
        REQUIRE(batch.categories(static_cast<Index>(p)) == problem.categories);
        const LowerTriangle triangle = batch.distances(static_cast<Index>(p));
        REQUIRE(triangle.points == static_cast<Index>(rows.size()));
        bool equal = true;
        for (Index i = 0; i < triangle.points; ++i)
          for (Index j = 0; j < i; ++j) equal &= triangle.row(i)[j] == views.distances(rows[i], rows[j]);
        REQUIRE(equal);
      }
    }
    CHECK(batch.draw(62, 0, 1 << 30) == ProblemBatch::kMaxProblems);
  }
}

TEST_CASE("a batch of large problems has as many as fit into memory") {
  const Scattered views(6000, 40, 150);
  const ClusteringProblems problems(views.category, views.object, views.pose, {.min_categories = 30});
  ProblemBatch batch(views.distances, problems, Parallel::shared());
  std::uint64_t done = 0, batches = 0;
  while (done < 40) {
    const std::uint64_t drawn = batch.draw(63, done, 40 - done);
    REQUIRE(drawn > 0);
    done += drawn;
    ++batches;
  }
  CHECK(done == 40);
  CHECK(batches > 1);
}

TEST_CASE("rows of a triangle are whole cache lines without gaps") {
  Index offset = 0;
  for (Index i = 0; i < 100; ++i) {
    CHECK(LowerTriangle::row_offset(i) == offset);
    offset += (i + 15) / 16 * 16;
    CHECK(LowerTriangle::size(i + 1) == offset);
  }
}

TEST_CASE("scores from pair counts equal those of the contingency") {
  RandomStream random(64, Stream::shuffle);
  PairScores scores(9);
  for (int repeat = 0; repeat < 300; ++repeat) {
    const std::size_t n = 1 + random.below(60);
    std::vector<std::int32_t> truth(n), prediction(n);
    for (auto& label : truth) label = static_cast<std::int32_t>(random.below(1 + repeat % 9));
    for (auto& label : prediction) label = static_cast<std::int32_t>(random.below(9));
    Contingency contingency(60);
    contingency.count(truth, prediction);
    std::vector<double> expected(n), individual(n);
    for (const Singletons singletons : {Singletons::zero, Singletons::skip}) {
      contingency.fowlkes_mallows_individual(singletons, expected);
      const std::size_t before = allocations();
      const double global = scores.score(truth, prediction, singletons, individual);
      CHECK(allocations() == before);
      CHECK(global == contingency.fowlkes_mallows());
      for (std::size_t i = 0; i < n; ++i)
        CHECK((individual[i] == expected[i] || (std::isnan(individual[i]) && std::isnan(expected[i]))));
    }
  }
}
