#include "predict/view_choice.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::predict;
using svnet::view::CameraPose;

namespace {

/// By the definition: each time the best sum of score and distance, far enough from all before it.
std::vector<std::size_t> chosen_by_definition(const std::vector<float>& scores, const std::vector<CameraPose>& poses,
                                              std::size_t most, double min_angle_deg) {
  double mean = 0, deviation = 0;
  for (const float score : scores) mean += score / static_cast<double>(scores.size());
  for (const float score : scores) deviation += (score - mean) * (score - mean) / static_cast<double>(scores.size());
  deviation = std::sqrt(deviation);
  std::vector<std::size_t> chosen;
  while (chosen.size() < most) {
    std::size_t best = poses.size();
    double highest = -1e9;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (std::ranges::find(chosen, i) != chosen.end()) continue;
      double nearest = 180;
      for (const std::size_t other : chosen)
        nearest = std::min(nearest, view::angle_between_deg(poses[i], poses[other]));
      const double value = scores[i] + (chosen.empty() ? 0 : deviation * std::min(nearest, 90.0) / 90);
      if (nearest >= min_angle_deg - 1e-4 && value > highest + 1e-12) highest = value, best = i;
    }
    if (best == poses.size()) break;
    chosen.push_back(best);
  }
  return chosen;
}

}  // namespace

TEST_CASE("the best views are the greedy choice by its definition") {
  const std::vector<CameraPose> poses = view::fibonacci_half_sphere(120, 0);
  std::vector<float> scores;
  for (std::size_t i = 0; i < poses.size(); ++i) scores.push_back(static_cast<float>((i * 37) % 50) / 50);  // with ties
  for (const double min_angle_deg : {0.0, 10.0, 45.0, 90.0, 180.0})
    for (const std::size_t most : {1, 3, 120}) {
      INFO(min_angle_deg << " degrees, at most " << most);
      std::vector<std::size_t> chosen(most);
      chosen.resize(best_views(scores, poses, min_angle_deg, chosen));
      CHECK(chosen == chosen_by_definition(scores, poses, most, min_angle_deg));
    }
}

TEST_CASE("poses that are as far away as asked count, and equal poses only without a distance") {
  const std::vector<CameraPose> poses{{0, 0}, {45, 0}, {90, 0}, {360, 0}};
  const std::vector<float> scores{0.9f, 0.8f, 0.7f, 0.9f};
  std::array<std::size_t, 4> chosen{};
  CHECK(best_views(scores, poses, 45, chosen) == 3);
  CHECK(chosen == std::array<std::size_t, 4>{0, 1, 2, 0});
  CHECK(best_views(scores, poses, 0, chosen) == 4);
  CHECK(chosen == std::array<std::size_t, 4>{0, 3, 1, 2});
  CHECK(best_views(scores, poses, 45.001, chosen) == 2);
  CHECK(chosen[1] == 2);
}

TEST_CASE("choices without poses, room or a possible angle are refused") {
  std::array<std::size_t, 1> one{};
  const std::vector<CameraPose> poses{{0, 0}};
  const std::vector<float> scores{0.5f};
  CHECK_THROWS_WITH(best_views({}, {}, 10, one), "[predict] there is no pose to choose from");
  CHECK_THROWS_WITH(best_views(scores, poses, 10, {}), "[views] 0 views are to be chosen, expected at least one");
  CHECK_THROWS_WITH(best_views(scores, poses, -1, one),
                    "[views] the views are to differ by -1 degrees, expected 0 to 180");
}
