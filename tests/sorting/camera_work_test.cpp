#include "sorting/camera_work.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace svnet;
using sorting::camera_work;

TEST_CASE("a move takes a start and its angle") {
  const sorting::MoveTime time{.start_s = 2, .speed_deg_per_s = 30};
  const auto one = camera_work(std::vector<view::CameraPose>{{0, 45}}, time);
  CHECK(one.moves == 1);
  CHECK(one.seconds == Approx(2 + 45.0 / 30));
  const auto two = camera_work(std::vector<view::CameraPose>{{0, 60}, {180, 60}}, time);  // 30, then 60 degrees
  CHECK(two.moves == 2);
  CHECK(two.seconds == Approx(2 + 1 + 2 + 2));
}

TEST_CASE("to see an object from above, or again from the same place, is no move") {
  CHECK(camera_work(std::vector<view::CameraPose>{{90, 90}}, {}).moves == 0);
  CHECK(camera_work(std::vector<view::CameraPose>{{0, 90}}, {}).seconds == 0);
  CHECK(camera_work(std::vector<view::CameraPose>{{0, 45}, {0, 45}}, {}).moves == 1);
}
