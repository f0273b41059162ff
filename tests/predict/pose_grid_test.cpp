#include "predict/pose_grid.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace svnet;

TEST_CASE("the paper's grid has seven azimuths at three elevations, and the top") {
  const std::vector<Pose> grid = paper_grid();
  REQUIRE(grid.size() == 22);
  CHECK(grid.front() == Pose{0, 45});
  CHECK(grid[6] == Pose{315, 45});
  CHECK(grid[7] == Pose{0, 60});
  CHECK(grid[20] == Pose{315, 75});
  CHECK(grid.back() == Pose{90, 90});
  CHECK(std::none_of(grid.begin(), grid.end(), [](const Pose& pose) { return pose.theta_deg == 270; }));
  CHECK(std::all_of(grid.begin(), grid.end(), [](const Pose& pose) { return pose_problem(pose).empty(); }));
}
