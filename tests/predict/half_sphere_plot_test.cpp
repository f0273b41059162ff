#include "predict/half_sphere_plot.h"

#include <array>
#include <catch2/catch.hpp>
#include <limits>

using namespace svnet;
using namespace svnet::predict;
using namespace svnet::view;

namespace {

using Pixel = std::array<int, 3>;
constexpr Pixel kLowest{48, 18, 92}, kMiddle{33, 145, 140}, kHighest{253, 231, 37}, kRing{214, 39, 40},
    kWhite{255, 255, 255};

Pixel pixel(const Image& image, Index x, Index y) {
  const std::uint8_t* rgb = &image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

TEST_CASE("poses are drawn as seen from above, coloured by score, with a ring around the best") {
  const std::vector<CameraPose> poses{{0, 45}, {90, 45}, {-180, 0}, {90, 90}};
  const Image image = half_sphere_plot(poses, std::vector<float>{0.5f, 0.9f, 0.1f, 0.5f});
  REQUIRE(image.height == 512);
  REQUIRE(image.width == 512);
  REQUIRE(image.rgb.size() == 512 * 512 * 3);
  CHECK(pixel(image, 256 + 116, 256) == kMiddle);      // to the right, half way
  CHECK(pixel(image, 256, 256 - 116) == kHighest);     // up
  CHECK(pixel(image, 256 - 232, 256) == kLowest);      // at the left rim
  CHECK(pixel(image, 256, 256) == kMiddle);            // the top view
  CHECK(pixel(image, 256 + 16, 256 - 116) == kRing);   // around the best
  CHECK(pixel(image, 256 + 116, 256 + 16) == kWhite);  // not around another
  CHECK(pixel(image, 2, 2) == kWhite);
}

TEST_CASE("of dots at the same place the best is on top; equal scores all have the highest colour") {
  const std::vector<CameraPose> poses{{0, 90}, {90, 90}, {180, 90}};
  CHECK(pixel(half_sphere_plot(poses, std::vector<float>{0.1f, 0.9f, 0.5f}), 256, 256) == kHighest);
  CHECK(pixel(half_sphere_plot(poses, std::vector<float>{0.5f, 0.5f, 0.5f}), 256, 256) == kHighest);
}

TEST_CASE("poses and scores that cannot be drawn are refused") {
  const std::vector<CameraPose> poses{{0, 45}, {0, 99}};
  CHECK_THROWS_WITH(half_sphere_plot(poses, std::vector<float>{0.5f}), "[plot] there are 2 poses and 1 scores");
  CHECK_THROWS_WITH(half_sphere_plot(poses, std::vector<float>{0.5f, 0.5f}),
                    "[plot] pose 1: phi 99 is outside [0, 90] degrees");
  CHECK_THROWS_WITH(
      half_sphere_plot(std::span(poses).first(1), std::vector<float>{std::numeric_limits<float>::infinity()}),
      "[plot] score 0 is inf, not a finite number");
  CHECK_THROWS_WITH(half_sphere_plot({}, {}), "[predict] there is no pose to choose from");
}
