#include "semantics/set_scores.h"

#include <catch2/catch.hpp>

#include "semantics/exact_expectation.h"
#include "semantics/random_points.h"

using namespace svnet;
using namespace svnet::semantics;

namespace {

constexpr Index kDimension = 3;

/// Features that a clustering groups correctly for some views and wrongly for others.
std::vector<float> features_of(const SmallDataset& dataset) {
  RandomStream random(83, Stream::shuffle);
  std::vector<float> features;
  for (const std::int64_t category : dataset.category)
    for (int d = 0; d < kDimension; ++d)
      features.push_back(static_cast<float>(1.5 * std::sin(1.7 * static_cast<double>(category + d)) + random.normal()));
  return features;
}

/// All pairs of views of each pose, as the views of a dataset of their own.
struct Pairs {
  SmallDataset views, pairs;
  ViewSets sets{.size = 2};

  explicit Pairs(ViewFusion fusion) {
    views.add(10, 1, 1, 3);
    views.add(10, 2, 1, 2);
    views.add(-3, 1, 1, 3);
    views.add(-3, 7, 5, 2);
    views.add(20, 1, 1, 2);
    views.add(20, 2, 1, 2);
    views.add(20, 2, 9, 3);
    views.add(4, 1, 1, 2);
    sets.fusion = fusion;
    for (Index v = 0; v < views.views(); ++v)
      for (Index w = v + 1; w < views.views() && same_pose(v, w); ++w) {
        sets.views.push_back(static_cast<std::int32_t>(v));
        sets.views.push_back(static_cast<std::int32_t>(w));
        pairs.add(at(views.category, v), at(views.object, v), at(views.pose, v), 1);
      }
  }

  static std::int64_t at(const std::vector<std::int64_t>& values, Index i) {
    return values[static_cast<std::size_t>(i)];
  }
  bool same_pose(Index v, Index w) const {
    return at(views.category, v) == at(views.category, w) && at(views.object, v) == at(views.object, w) &&
           at(views.pose, v) == at(views.pose, w);
  }
  ClusteringProblems problems() const { return {pairs.category, pairs.object, pairs.pose}; }
};

/// The features of the sets, from those of the views.
std::vector<float> fused(const ViewSets& sets, const std::vector<float>& features) {
  std::vector<float> result;
  const auto feature = [&](std::int32_t view, Index d) {
    return features[static_cast<std::size_t>(view * kDimension + d)];
  };
  for (Index i = 0; i < sets.count(); ++i) {
    if (sets.fusion == ViewFusion::concatenate) {
      for (const std::int32_t view : sets.set(i))
        for (Index d = 0; d < kDimension; ++d) result.push_back(feature(view, d));
      continue;
    }
    for (Index d = 0; d < kDimension; ++d) {
      double sum = 0;
      for (const std::int32_t view : sets.set(i)) sum += feature(view, d);
      result.push_back(static_cast<float>(sum / static_cast<double>(sets.size)));
    }
  }
  return result;
}

}  // namespace

TEST_CASE("distances of sets are those of their fused features") {
  const Pairs pairs(ViewFusion::mean);
  const auto features = features_of(pairs.views);
  const DistanceMatrix distances = distances_of(features, kDimension);
  for (const Index size : {1, 2, 3})
    for (const ViewFusion fusion : {ViewFusion::mean, ViewFusion::concatenate}) {
      ViewSets sets{.size = size, .fusion = fusion};
      for (std::int32_t i = 0; i < 6 * size; ++i) sets.views.push_back(i * 5 % 17);
      const auto expected =
          distances_of(fused(sets, features), fusion == ViewFusion::mean ? kDimension : kDimension * size);
      SetDistances of_sets(size, fusion, 6);
      const LowerTriangle triangle = of_sets.of(distances, sets.views);
      REQUIRE(triangle.points == 6);
      for (Index i = 1; i < 6; ++i)
        for (Index j = 0; j < i; ++j) CHECK(triangle.row(i)[j] == Approx(expected(i, j)).margin(1e-5));
    }
}

TEST_CASE("distances with a partner are those of the sets of two") {
  const Pairs pairs(ViewFusion::mean);
  const auto features = features_of(pairs.views);
  const DistanceMatrix distances = distances_of(features, kDimension);
  std::vector<std::int32_t> partner;
  for (std::int32_t v = 0; v < distances.size(); ++v) partner.push_back(v / 3 * 3);
  for (const ViewFusion fusion : {ViewFusion::mean, ViewFusion::concatenate}) {
    ViewSets sets{.size = 2, .fusion = fusion};
    for (std::int32_t v = 0; v < distances.size(); ++v) {
      sets.views.push_back(v);
      sets.views.push_back(partner[static_cast<std::size_t>(v)]);
    }
    const auto expected = distances_of(fused(sets, features), fusion == ViewFusion::mean ? kDimension : 2 * kDimension);
    const DistanceMatrix actual = distances_with_partner(distances, partner, fusion, Parallel::shared());
    for (Index v = 0; v < distances.size(); ++v)
      for (Index w = 0; w < distances.size(); ++w) CHECK(actual(v, w) == Approx(expected(v, w)).margin(1e-5));
  }
  partner.pop_back();
  CHECK_THROWS_WITH(distances_with_partner(distances, partner, ViewFusion::mean, Parallel::shared()),
                    "[sets] 18 partners for 19 views");
}

TEST_CASE("scores of sets are within four standard errors of the exact expectations") {
  for (const ViewFusion fusion : {ViewFusion::mean, ViewFusion::concatenate}) {
    const Pairs pairs(fusion);
    const auto features = features_of(pairs.views);
    const DistanceMatrix distances = distances_of(features, kDimension);
    const DistanceMatrix of_pairs =
        distances_of(fused(pairs.sets, features), fusion == ViewFusion::mean ? kDimension : 2 * kDimension);
    const ExactScores exact = exact_scores(of_pairs, all_problems(pairs.pairs, 3), Singletons::zero);
    const auto scores =
        set_scores(distances, pairs.sets, pairs.problems(), {.problems = 100000, .seed = 72}, Parallel::shared());
    for (std::size_t i = 0; i < exact.individual.size(); ++i) {
      INFO("pair " << i);
      const double count = static_cast<double>(scores.count[i]);
      CHECK(std::abs(scores.global[i] - exact.global[i]) < 4 * 0.5 / std::sqrt(count));
      CHECK(std::abs(scores.individual[i] - exact.individual[i]) <= 4 * scores.standard_error[i]);
    }
  }
}

TEST_CASE("scores of sets have the same bits for any number of threads") {
  const Pairs pairs(ViewFusion::mean);
  const DistanceMatrix distances = distances_of(features_of(pairs.views), kDimension);
  const ClusteringProblems problems = pairs.problems();
  const auto sums_with = [&](int threads) {
    Parallel parallel(threads);
    SingleProcess single;
    ScoreSums sums(pairs.sets.count());
    continue_set_scores(distances, pairs.sets, problems, {.problems = 5000, .seed = 3}, parallel, single, sums);
    return sums;
  };
  const ScoreSums one = sums_with(1);
  CHECK(sums_with(2) == one);
  CHECK(sums_with(5) == one);
}

TEST_CASE("scores of sets of one view are those of the views") {
  const SmallDataset dataset = SmallDataset::uneven();
  const DistanceMatrix distances = distances_of(features_of(dataset), kDimension);
  const ClusteringProblems problems(dataset.category, dataset.object, dataset.pose);
  ViewSets sets;
  for (std::int32_t v = 0; v < dataset.views(); ++v) sets.views.push_back(v);
  const ScoreOptions options{.problems = 3000, .seed = 4};
  const auto of_views = semantic_scores(distances, problems, options, Parallel::shared());
  const auto of_sets = set_scores(distances, sets, problems, options, Parallel::shared());
  CHECK(of_sets.count == of_views.count);
  for (std::size_t v = 0; v < of_views.individual.size(); ++v)
    CHECK(of_sets.individual[v] == Approx(of_views.individual[v]).margin(1e-3));
}

TEST_CASE("sets that do not fit are refused") {
  const Pairs pairs(ViewFusion::mean);
  const DistanceMatrix distances = distances_of(features_of(pairs.views), kDimension);
  ViewSets sets = pairs.sets;
  sets.views[3] = 19;
  CHECK_THROWS_WITH(set_scores(distances, sets, pairs.problems(), {.problems = 1}, Parallel::shared()),
                    "[sets] a set has view 19 of 19");
  sets.views.resize(4);
  CHECK_THROWS_WITH(set_scores(distances, sets, pairs.problems(), {.problems = 1}, Parallel::shared()),
                    Catch::Contains("[sets] 2 sets, but problems of"));
}
