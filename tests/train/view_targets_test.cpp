#include "train/view_targets.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace svnet;
using namespace svnet::train;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Two categories of one pose each, with three views.
ViewDataset two_poses() {
  ViewDataset dataset;
  dataset.categories = {"a", "b"};
  for (Index p = 0; p < 2; ++p) {
    dataset.objects.push_back({"o", p});
    dataset.poses.push_back({"1", p, p, 3 * p, 3, 3 * p});
    for (Index v = 0; v < 3; ++v) dataset.views.push_back({std::to_string(3 * p + v), p, p, p, 90, 0, v == 0});
  }
  return dataset;
}

Scores scores_of(const ViewDataset& dataset) {
  Scores scores;
  for (const View& view : dataset.views) scores.paths.push_back(view.path);
  scores.individual = {0.2, 0.4, 0.6, 0.5, kNaN, 0.7};
  scores.global = {0.6, 0.4, 0.2, 0.1, 0.2, 0.4};
  scores.scaled = {0, 0.5, 1, 0, kNaN, 1};
  scores.standard_error = {0.1, 0.2, kNaN, 0, kNaN, 0.1};
  return scores;
}

}  // namespace

TEST_CASE("scaled targets are the scaled scores, all with weight 1") {
  const ViewDataset dataset = two_poses();
  const Scores scores = scores_of(dataset);
  const ViewTargets individual = view_targets(dataset, scores, {true, true}, Target::individual, TargetScale::scaled);
  for (std::size_t v : {0, 1, 2, 3, 5}) CHECK(individual.values[v] == scores.scaled[v]);
  CHECK(std::isnan(individual.values[4]));
  CHECK(individual.weights == std::vector<double>(6, 1));
  const ViewTargets global = view_targets(dataset, scores, {true, false}, Target::global, TargetScale::scaled);
  CHECK(global.values[0] == Approx(1));
  CHECK(global.values[2] == Approx(0).margin(1e-12));
  for (std::size_t v : {3, 4, 5}) CHECK(std::isnan(global.values[v]));
}

TEST_CASE("centred targets have the mean 1/2 in each pose, and less weight the less is known of them") {
  const ViewDataset dataset = two_poses();
  const ViewTargets targets =
      view_targets(dataset, scores_of(dataset), {true, true}, Target::individual, TargetScale::centred);
  const std::vector<double> expected{0.3, 0.5, 0.7, 0.4, kNaN, 0.6};
  for (std::size_t v : {0, 1, 2, 3, 5}) CHECK(targets.values[v] == Approx(expected[v]));
  CHECK(std::isnan(targets.values[4]));
  // Squares within the poses: .08 and .02, with 2 + 1 degrees of freedom.
  const double variance = 0.1 / 3;
  CHECK(targets.weights[0] == Approx(variance / (variance + 0.01)));
  CHECK(targets.weights[1] == Approx(variance / (variance + 0.04)));
  CHECK(targets.weights[2] == targets.weights[1]);  // an unknown error is at least as large as any other
  CHECK(targets.weights[3] == 1);

  const ViewTargets first =
      view_targets(dataset, scores_of(dataset), {true, false}, Target::individual, TargetScale::centred);
  CHECK(first.weights[0] == Approx(0.04 / 0.05));  // only categories that count say how scores vary
  CHECK(std::isnan(first.values[3]));
}

TEST_CASE("targets of scores of other views are refused") {
  const ViewDataset dataset = two_poses();
  Scores scores = scores_of(dataset);
  scores.paths[2] = "other";
  CHECK_THROWS(view_targets(dataset, scores, {true, true}, Target::individual, TargetScale::scaled));
}
