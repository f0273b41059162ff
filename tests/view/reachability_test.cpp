#include "view/reachability.h"

#include <catch2/catch.hpp>

using namespace svnet;
using namespace svnet::view;

TEST_CASE("listed poses are reachable, up to half a degree of arc and full turns") {
  const Reachable reachable = listed_poses({{0, 45}, {315, 60}, {90, 90}});
  const auto asked = [&](double theta, double phi) { return reachable({theta, phi}, Eigen::Isometry3d::Identity()); };
  CHECK(asked(0, 45));
  CHECK(asked(360, 45.4));
  CHECK(asked(-45, 60));
  CHECK(asked(10, 90));  // the top view, at any azimuth
  CHECK_FALSE(asked(0, 45.6));
  CHECK_FALSE(asked(1, 45));
  CHECK_FALSE(asked(0, 60));
  CHECK_FALSE(listed_poses({})({0, 45}, Eigen::Isometry3d::Identity()));
}
