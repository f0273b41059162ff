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

TEST_CASE("a grid has its azimuths at each elevation, and one pose at the top") {
  const std::vector<CameraPose> expected{{0, 30},  {90, 30},  {180, 30}, {270, 30}, {0, 60},
                                         {90, 60}, {180, 60}, {270, 60}, {90, 90}};
  CHECK(pose_grid({4, 3, 30, 90}) == expected);
  CHECK(grid_size({4, 3, 30, 90}) == 9);
  CHECK(pose_grid({2, 1, 45, 80}) == std::vector<CameraPose>{{0, 45}, {180, 45}});
  CHECK(pose_grid({7, 1, 90, 90}) == std::vector<CameraPose>{kTopView});
  CHECK(grid_size({}) == 36 * 9 + 1);
  CHECK(pose_grid({5, 4, 0, 77.7}).back() == CameraPose{288, 77.7});
}

TEST_CASE("grids out of range are refused") {
  CHECK_THROWS_WITH(pose_grid({0, 3, 30, 90}), "[view] a grid of 0 theta steps, expected 1 to 3600");
  CHECK_THROWS_WITH(grid_size({3601, 3, 30, 90}), "[view] a grid of 3601 theta steps, expected 1 to 3600");
  CHECK_THROWS_WITH(grid_size({4, 1001, 30, 90}), "[view] a grid of 1001 phi steps, expected 1 to 1000");
  CHECK_THROWS_WITH(grid_size({4, 2, 60, 30}),
                    "[view] a grid with phi from 60 to 30 degrees, expected 0 <= lowest <= highest <= 90");
  CHECK_THROWS_WITH(grid_size({4, 2, 0, std::nan("")}),
                    "[view] a grid with phi from 0 to nan degrees, expected 0 <= lowest <= highest <= 90");
}

TEST_CASE("the angle between poses is that of their directions") {
  CHECK(angle_between_deg({0, 0}, {90, 0}) == Approx(90));
  CHECK(angle_between_deg({0, 0}, {180, 0}) == Approx(180));
  CHECK(angle_between_deg({0, 45}, {180, 45}) == Approx(90));
  CHECK(angle_between_deg({10, 30}, {10, 75}) == Approx(45));
  CHECK(angle_between_deg({0, 90}, {123, 90}) == Approx(0).margin(1e-12));
  CHECK(angle_between_deg({-45, 20}, {315, 20}) == Approx(0).margin(1e-12));
  CHECK(angle_between_deg({0, 45}, {1e-7, 45}) == Approx(1e-7 * std::sqrt(0.5)));
  // Against the scalar product of unit vectors.
  const auto direction = [](const CameraPose& pose) {
    const double theta = pose.theta_deg * M_PI / 180, phi = pose.phi_deg * M_PI / 180;
    return Eigen::Vector3d(std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi));
  };
  const std::vector<CameraPose> poses = fibonacci_half_sphere(40, 0);
  for (const CameraPose& a : poses)
    for (const CameraPose& b : poses)
      if (!(a == b)) CHECK(angle_between_deg(a, b) == Approx(std::acos(direction(a).dot(direction(b))) * 180 / M_PI));
}
