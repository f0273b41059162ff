#include "train/within_pose.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet;
using namespace svnet::train;

TEST_CASE("rank correlation agrees with SciPy's spearmanr") {
  const std::vector<double> a{1, 2, 3, 4, 5}, b{5, 6, 7, 8, 7}, falling{5, 4, 3, 2, 1};
  CHECK(rank_correlation(a, b) == Approx(0.820782681668123));
  CHECK(rank_correlation(a, falling) == Approx(-1));
  CHECK(rank_correlation(a, std::vector<double>(5, 3)) == 0);
}

TEST_CASE("within poses: correlation, regret and the shares that beat the top view and the mean") {
  ViewDataset dataset;
  dataset.categories = {"a", "b"};
  for (Index p = 0; p < 2; ++p) {
    dataset.objects.push_back({"o", p});
    dataset.poses.push_back({"1", p, p, 4 * p, 4, 4 * p + 3});
    for (Index v = 0; v < 4; ++v)
      dataset.views.push_back({"x", p, p, p, v == 3 ? 90 : 45, v == 3 ? 90 : static_cast<int>(90 * v), v == 3});
  }
  const std::vector<double> scores{0.1, 0.5, 0.3, 0.2, 0.4, 0.1, 0.2, 0.9};
  const std::vector<double> predicted{1, 3, 2, 1.5, 1, 4, 3, 2};
  const WithinPose first = within_pose(dataset, predicted, scores, {true, false});
  CHECK(first.poses == 1);
  CHECK(first.spearman == Approx(1));
  CHECK(first.regret == Approx(0));
  CHECK(first.better_than_top == 1);
  CHECK(first.better_than_rand == 1);
  const WithinPose both = within_pose(dataset, predicted, scores, {true, true});
  CHECK(both.poses == 2);
  CHECK(both.regret == Approx((0 + 0.8) / 2));
  CHECK(both.better_than_top == Approx(0.5));

  std::vector<double> unknown = scores;
  unknown[0] = unknown[1] = std::nan("");
  CHECK(std::isnan(within_pose(dataset, predicted, unknown, {true, false}).spearman));
}
