#include "image/resize.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/sha256.h"

using namespace svnet;

namespace {

// As noise() of fixtures/make_image_fixtures.py.
Image noise(Index height, Index width) {
  Image image{height, width, {}};
  std::uint32_t state = 1;
  for (Index i = 0; i < height * width * 3; ++i) {
    state = 1664525 * state + 1013904223;
    image.rgb.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return image;
}

Image filled(Index height, Index width, std::uint8_t value) {
  return {height, width, std::vector<std::uint8_t>(static_cast<std::size_t>(height * width * 3), value)};
}

}  // namespace

TEST_CASE("resized gives Pillow's bits") {
  std::ifstream fixtures(SVNET_FIXTURES "/image.txt");
  REQUIRE(fixtures);
  int cases = 0;
  for (std::string line; std::getline(fixtures, line);) {
    std::istringstream words(line);
    std::string kind, interpolation, sha256;
    Index from_height, from_width, height, width;
    words >> kind >> from_height >> from_width >> height >> width >> interpolation >> sha256;
    if (kind != "resize") continue;
    CAPTURE(line);
    const Image image = resized(noise(from_height, from_width), height, width, interpolation_named(interpolation));
    CHECK(image.height == height);
    CHECK(image.width == width);
    std::vector<std::uint8_t> expected;
    for (int value; words >> value;) expected.push_back(static_cast<std::uint8_t>(value));
    if (!expected.empty()) CHECK(image.rgb == expected);
    CHECK(Sha256().update(image.rgb.data(), image.rgb.size()).hex() == sha256);
    ++cases;
  }
  CHECK(cases == 24);
}

TEST_CASE("an image of one colour keeps it at every size") {
  for (const Index side : {1, 2, 3, 7, 64, 100})
    for (const auto interpolation : {Interpolation::nearest, Interpolation::bilinear})
      for (const std::uint8_t value : {0, 1, 254, 255})
        CHECK(resized(filled(13, 29, value), side, 2 * side, interpolation).rgb == filled(side, 2 * side, value).rgb);
}

TEST_CASE("an image without pixels, or with a wrong number of pixels, is refused") {
  CHECK_THROWS_WITH(resized({}, 4, 5, Interpolation::nearest),
                    "[resize] cannot make a 4x5 image of a 0x0 image: every side must be at least 1");
  CHECK_THROWS_WITH(resized(noise(2, 3), 0, 5, Interpolation::bilinear),
                    "[resize] cannot make a 0x5 image of a 2x3 image: every side must be at least 1");
  Image broken = noise(2, 3);
  broken.rgb.pop_back();
  CHECK_THROWS_WITH(resized(broken, 4, 5, Interpolation::nearest), "[resize] a 2x3x3 image has 17 values, expected 18");
}

TEST_CASE("interpolations have names") {
  CHECK(interpolation_named("nearest") == Interpolation::nearest);
  CHECK(interpolation_named("bilinear") == Interpolation::bilinear);
  CHECK(name_of(Interpolation::nearest) == std::string("nearest"));
  CHECK_THROWS_WITH(interpolation_named("bilinar"), "interpolation 'bilinar' is not known, did you mean 'bilinear'?");
}
