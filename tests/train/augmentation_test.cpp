#include "train/augmentation.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace svnet;
using namespace svnet::train;

namespace {

constexpr Augmentation kNothing{
    .zoom = 0, .shift = 0, .turn_deg = 0, .flip = 0, .brightness = 0, .contrast = 0, .colour = 0, .noise = 0};

/// An image whose pixels all have different grey levels.
Image ramp() {
  Image image{5, 7, {}};
  for (int i = 0; i < 5 * 7 * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(40 + i));
  return image;
}

Image changed(const Image& image, const Augmentation& how, std::uint64_t number) {
  RandomStream random(3, Stream::augmentation, number);
  return augmented(image, how, random);
}

int at(const Image& image, Index y, Index x, Index c) {
  return image.rgb[static_cast<std::size_t>((y * image.width + x) * 3 + c)];
}

}  // namespace

TEST_CASE("without augmentation an image does not change; with it, the random stream determines the change") {
  const Image image = ramp();
  CHECK(changed(image, kNothing, 1).rgb == image.rgb);
  const Image once = changed(image, {}, 1), again = changed(image, {}, 1), other = changed(image, {}, 2);
  CHECK(once.height == 5);
  CHECK(once.width == 7);
  CHECK(once.rgb == again.rgb);
  CHECK(once.rgb != image.rgb);
  CHECK(once.rgb != other.rgb);
}

TEST_CASE("a flip exchanges left and right") {
  Augmentation how = kNothing;
  how.flip = 1;
  const Image image = ramp(), flipped = changed(image, how, 1);
  for (Index y = 0; y < 5; ++y)
    for (Index x = 0; x < 7; ++x)
      for (Index c = 0; c < 3; ++c) CHECK(at(flipped, y, x, c) == at(image, y, 6 - x, c));
}

TEST_CASE("each change stays in its range and uses most of it") {
  // On an image of one grey level only tone and noise are visible.
  const Image grey{8, 8, std::vector<std::uint8_t>(192, 100)};
  const auto range = [&](const Augmentation& how) {
    int least = 255, most = 0;
    for (std::uint64_t number = 0; number < 300; ++number)
      for (const int level : changed(grey, how, number).rgb)
        least = std::min(least, level), most = std::max(most, level);
    return std::pair(least, most);
  };
  Augmentation how = kNothing;
  how.brightness = 0.25;
  CHECK(range(how).first <= 82);
  CHECK(range(how).first >= 80);
  CHECK(range(how).second >= 122);
  CHECK(range(how).second <= 125);
  how = kNothing;
  how.contrast = 0.25;  // the grey level is 27.5 below the middle
  CHECK(range(how).first <= 95);
  CHECK(range(how).first >= 93);
  CHECK(range(how).second >= 104);
  CHECK(range(how).second <= 106);
  how = kNothing;
  how.noise = 6;
  CHECK(range(how).first <= 96);
  CHECK(range(how).first >= 94);
  CHECK(range(how).second >= 104);
  CHECK(range(how).second <= 106);
  how = kNothing;
  how.zoom = how.shift = 0.3;
  how.turn_deg = 40;
  CHECK(range(how) == std::pair(100, 100));
}

TEST_CASE("a rotation is about the centre, and a shift moves it") {
  Image image{9, 9, std::vector<std::uint8_t>(243, 0)};
  for (std::size_t c = 0; c < 3; ++c) image.rgb[(4 * 9 + 4) * 3 + c] = 255;
  Augmentation how = kNothing;
  how.turn_deg = 180;
  for (std::uint64_t number = 0; number < 20; ++number) CHECK(at(changed(image, how, number), 4, 4, 0) == 255);
  how = kNothing;
  how.shift = 0.45;
  int moved = 0;
  for (std::uint64_t number = 0; number < 20; ++number) moved += at(changed(image, how, number), 4, 4, 0) < 10;
  CHECK(moved > 10);
}
