#include "view/pose_grid.h"

#include <Eigen/Core>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet;
using namespace svnet::view;

TEST_CASE("the paper's grid has seven azimuths at three elevations, and the top") {
  const std::vector<CameraPose> grid = paper_grid();
  REQUIRE(grid.size() == 22);
  CHECK(grid.front() == CameraPose{0, 45});
  CHECK(grid[6] == CameraPose{315, 45});
  CHECK(grid[7] == CameraPose{0, 60});
  CHECK(grid[20] == CameraPose{315, 75});
  CHECK(grid.back() == CameraPose{90, 90});
  CHECK(std::none_of(grid.begin(), grid.end(), [](const CameraPose& pose) { return pose.theta_deg == 270; }));
  CHECK(std::all_of(grid.begin(), grid.end(), [](const CameraPose& pose) { return pose_problem(pose).empty(); }));
}

TEST_CASE("a Fibonacci half-sphere covers the half-sphere evenly") {
  constexpr Index kCount = 400;
  const std::vector<CameraPose> poses = fibonacci_half_sphere(kCount, 0);
  REQUIRE(poses.size() == kCount);
  std::vector<Eigen::Vector3d> directions;
  for (const CameraPose& pose : poses) {
    REQUIRE(pose_problem(pose).empty());
    const double theta = pose.theta_deg * EIGEN_PI / 180, phi = pose.phi_deg * EIGEN_PI / 180;
    directions.emplace_back(std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi));
  }
  // A pose's share of the half-sphere is 2π / 400, a disc of radius 0.1: neighbours are about 1.5 to 2 of these apart.
  for (std::size_t i = 0; i < directions.size(); ++i) {
    double nearest = 9;
    for (std::size_t j = 0; j < directions.size(); ++j)
      if (j != i) nearest = std::min(nearest, (directions[i] - directions[j]).norm());
    CHECK(nearest > 0.09);
    CHECK(nearest < 0.17);
  }
  // Half of the area lies above 30°, and all of it above the lowest elevation.
  CHECK(std::count_if(poses.begin(), poses.end(), [](const CameraPose& pose) { return pose.phi_deg > 30; }) ==
        kCount / 2);
  for (const CameraPose& pose : fibonacci_half_sphere(50, 40)) CHECK(pose.phi_deg > 40);
  CHECK_THROWS_WITH(fibonacci_half_sphere(0, 0), "[view] 0 poses are no half-sphere, expected at least one");
  CHECK_THROWS_WITH(fibonacci_half_sphere(3, 90), "[view] the lowest phi is 90 degrees, expected one in [0, 90)");
}
