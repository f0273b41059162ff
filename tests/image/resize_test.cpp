#include "image/resize.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/instruction_sets.h"
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
    std::vector<std::uint8_t> expected;
    for (int value; words >> value;) expected.push_back(static_cast<std::uint8_t>(value));
    test::for_instruction_sets([&](const std::string& set) {
      CAPTURE(set);
      const Image image = resized(noise(from_height, from_width), height, width, interpolation_named(interpolation));
      CHECK(image.height == height);
      CHECK(image.width == width);
      if (!expected.empty()) CHECK(image.rgb == expected);
      CHECK(Sha256().update(image.rgb.data(), image.rgb.size()).hex() == sha256);
    });
    ++cases;
  }
  CHECK(cases == 24);
}

TEST_CASE("vectors filter as the plain loops do, at odd sizes and with any weights") {
  std::uint32_t random = 1;
  const auto next = [&](std::uint32_t below) {
    return static_cast<Index>(((random = 1664525 * random + 1013904223) >> 8) % below);
  };
  for (int i = 0; i < 300; ++i) {
    const Index from = 1 + next(70), to = 1 + next(40), rows = 1 + next(9);
    ResizeFilter filter;
    filter.taps = std::min<Index>(from, 1 + next(20));
    for (Index k = 0; k < to; ++k) {
      const Index count = 1 + next(static_cast<std::uint32_t>(filter.taps));
      filter.counts.push_back(count);
      filter.starts.push_back(next(static_cast<std::uint32_t>(from - count + 1)));
      for (Index t = 0; t < filter.taps; ++t)  // also one weight of 1, and sums a little above it
        filter.weights.push_back(static_cast<std::int32_t>(t < count ? (1 << kFilterBits) / count + next(2) : 0));
    }
    const Image image = noise(rows, from);
    std::vector<std::uint8_t> plain(static_cast<std::size_t>(rows * to * 3)), fast;
    filter_width_reference(filter, image.rgb.data(), rows, from, to, plain.data());
    const Image turned = noise(from, rows);
    std::vector<std::uint8_t> plain_height(plain.size()), fast_height;
    filter_height_reference(filter, turned.rgb.data(), 3 * rows, to, plain_height.data());
    test::for_instruction_sets([&](const std::string& set) {
      CAPTURE(set, from, to, rows, filter.taps);
      fast.assign(plain.size(), 1);
      WidthBuffers buffers;
      filter_width(filter, image.rgb.data(), rows, from, to, fast.data(), buffers);
      CHECK(fast == plain);
      fast_height.assign(plain.size(), 1);
      filter_height(filter, turned.rgb.data(), 3 * rows, to, fast_height.data());
      CHECK(fast_height == plain_height);
    });
  }
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
