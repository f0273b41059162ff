#include "frame/heights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

Heights heights_in(const DepthImage& depth) {
  const Silhouette silhouette = silhouette_of(depth);
  return heights_of(depth, silhouette, axis_of(silhouette));
}

}  // namespace

TEST_CASE("a box has the height, flatness and volume of geometry") {
  const auto box = [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.25; };
  const double tilt_m = GENERATE(0.0, 0.02);
  const Heights heights = heights_in(depth_of(
      box, [](double, double) { return 0.04; }, tilt_m));
  // 1.2 of a radius of half a side, and a side is 1 / 1.25 of the distance at half the height.
  const double length_m = 0.6 * (0.5 - 0.02) / kPaperFocal_sides, height = 0.04 / length_m;
  REQUIRE(heights.are_known);
  CHECK(heights.measured == Approx(1));
  CHECK(heights.height == Approx(height).epsilon(0.03));
  CHECK(heights.mean_height == Approx(height).epsilon(0.05));
  CHECK(heights.width == Approx(0.5 / 1.2).epsilon(0.04));
  CHECK(heights.flatness > 0.95);
  CHECK(heights.footprint == Approx(0.5 / 1.2).epsilon(0.05));
  CHECK(heights.volume == Approx(height * 0.5 / 1.2).epsilon(0.08));
}

TEST_CASE("a ridge is less flat than a box, and half as high on average") {
  const auto box = [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.25; };
  const Heights ridge = heights_in(depth_of(box, [](double, double y) { return 0.04 * (1 - std::abs(y) / 0.25); }));
  REQUIRE(ridge.are_known);
  CHECK(ridge.flatness < 0.3);
  CHECK(ridge.mean_height == Approx(ridge.height / 2).epsilon(0.15));
}

TEST_CASE("pixels that were not measured do not count, and too few of them leave heights unknown") {
  const auto box = [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.25; };
  const DepthImage whole = depth_of(box, [](double, double) { return 0.04; });
  const Silhouette silhouette = silhouette_of(whole);
  const ObjectAxis axis = axis_of(silhouette);
  const Heights expected = heights_of(whole, silhouette, axis);
  DepthImage holes = whole;
  for (Index row = 0; row < 224; ++row)
    for (Index column = 112; column < 224; ++column)
      holes.metres[static_cast<std::size_t>(row * 224 + column)] =
          column % 2 == 0 ? 0 : std::numeric_limits<float>::quiet_NaN();
  const Heights heights = heights_of(holes, silhouette, axis);
  REQUIRE(heights.are_known);
  CHECK(heights.measured == Approx(0.5).epsilon(0.05));
  CHECK(heights.height == Approx(expected.height).epsilon(1e-3));
  for (Index row = 0; row < 224; ++row)
    for (Index column = 30; column < 112; ++column) holes.metres[static_cast<std::size_t>(row * 224 + column)] = 0;
  CHECK_FALSE(heights_of(holes, silhouette, axis).are_known);
}

TEST_CASE("heights of nothing are unknown, and bad input is an error") {
  const auto nothing = [](double, double) { return false; };
  const DepthImage table = depth_of(nothing, [](double, double) { return 0.0; });
  const Heights heights = heights_in(table);
  CHECK_FALSE(heights.are_known);
  CHECK(heights.height == 0);
  const Silhouette silhouette = silhouette_of(table);
  CHECK_THROWS_WITH(heights_of(DepthImage{}, silhouette, {}), "[frame] the depth image is empty: 0x0 pixels");
  CHECK_THROWS_WITH(heights_of(DepthImage{8, 8, std::vector<float>(64)}, silhouette, {}),
                    Catch::Contains("[frame] the table cannot be seen"));
  CHECK_THROWS_WITH(heights_of(table, silhouette, {}, 0), Catch::Contains("[frame] the focal length is 0 sides"));
}
