#include "view/pose_plot.h"

#include <array>
#include <catch2/catch.hpp>

using namespace svnet;
using namespace svnet::view;

TEST_CASE("poses that can be reached are filled, others are empty") {
  const std::vector<CameraPose> poses{{0, 45}, {90, 45}};
  const Image image = pose_plot(poses, {true, false});
  REQUIRE(image.height == 512);
  const auto pixel = [&](Index x, Index y) {
    const std::uint8_t* rgb = &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
    return std::array<int, 3>{rgb[0], rgb[1], rgb[2]};
  };
  CHECK(pixel(256 + 116, 256) == std::array{33, 145, 140});
  CHECK(pixel(256, 256 - 116) == std::array{255, 255, 255});
  CHECK(pixel(256, 256 - 116 - 9)[0] < 60);  // its outline
}
