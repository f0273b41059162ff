#include "frame/turned_image.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "frame/object_axis.h"
#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

/// The largest difference of two images of one size.
int most_different(const Image& a, const Image& b) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  int most = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  return most;
}

}  // namespace

TEST_CASE("an image turned to a camera at 90 degrees keeps the pixels of its circle") {
  const Image image = picture_of(letter_t(1.2, 33), {.height = 97, .width = 97});
  const Image turned = turned_image(image, 90);
  for (Index row = 0; row < 97; ++row)
    for (Index column = 0; column < 97; ++column) {
      const bool is_inside = (row - 48) * (row - 48) + (column - 48) * (column - 48) <= 48 * 48;
      if (!is_inside) continue;
      for (Index c = 0; c < 3; ++c) {
        const auto at = static_cast<std::size_t>((row * 97 + column) * 3 + c);
        REQUIRE(turned.rgb[at] == image.rgb[at]);
      }
    }
}

TEST_CASE("quarter turns are exact: of the camera, and of the image with the camera") {
  const Index side = GENERATE(96, 97);
  const Image image = picture_of(letter_t(1.2, 33), {.height = side, .width = side});
  const Image turned_scene = quarter_turned(image);
  for (const double theta : {90.0, 0.0, 180.0, 22.5, 45.0, 135.0, 317.0}) {
    CAPTURE(side, theta);
    const Image turned = turned_image(image, theta);
    CHECK(turned_image(image, theta - 90).rgb == quarter_turned(turned).rgb);
    CHECK(turned_image(turned_scene, theta + 90).rgb == turned.rgb);
    CHECK(turned_image(image, theta + 360).rgb == turned.rgb);
    CHECK(turned_image(image, theta - 720).rgb == turned.rgb);
  }
}

TEST_CASE("what lies towards the camera comes to the lower edge") {
  for (const double theta : {0.0, 30.0, 100.0, 190.0, 333.0}) {
    CAPTURE(theta);
    // A wedge at 0 degrees points its heavy end to the azimuth of 180.
    const Image image = picture_of(wedge(1.2, 0.5, theta - 180), {.noise = 1});
    const ObjectAxis axis = axis_of(silhouette_of(turned_image(image, theta)));
    CHECK(between_directions(axis.direction_deg, 90) < 1);
  }
}

TEST_CASE("turning there and back gives nearly the image") {
  const Image image = turned_image(picture_of(ellipse(1.3, 0.5, 20), {.gradient = 40, .noise = 0}), 90);
  const Image back = turned_image(turned_image(image, 60), 120);
  double squares = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) squares += std::pow(int{image.rgb[i]} - int{back.rgb[i]}, 2);
  CHECK(std::sqrt(squares / static_cast<double>(image.rgb.size())) < 1.5);
}

TEST_CASE("outside the circle a turned image has the mean colour of the rim at every angle") {
  const Image image = picture_of(ellipse(1, 0.5, 0), {.gradient = 0, .noise = 0});
  for (const double theta : {90.0, 0.0, 17.0}) {
    const Image turned = turned_image(image, theta);
    for (std::size_t c = 0; c < 3; ++c) CHECK(int{turned.rgb[c]} == int{image.rgb[c]});
    CHECK(most_different(turned, turned_image(turned, 90)) == 0);
  }
}

TEST_CASE("of an image that is not square the centred square is turned") {
  const Look square{.height = 96, .width = 96, .noise = 0}, wide{.height = 96, .width = 160, .noise = 0};
  const Shape shape = letter_t(1.2, 33);
  const Image turned = turned_image(picture_of(shape, wide), 30);
  CHECK(turned.height == 96);
  CHECK(turned.width == 96);
  CHECK(most_different(turned, turned_image(picture_of(shape, square), 30)) == 0);
}

TEST_CASE("a mirrored image has left and right exchanged") {
  const Image image{2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  CHECK(mirrored(image).rgb == std::vector<std::uint8_t>{4, 5, 6, 1, 2, 3, 10, 11, 12, 7, 8, 9});
  CHECK(mirrored(mirrored(image)).rgb == image.rgb);
}

TEST_CASE("images of a few pixels can be turned, empty ones are errors") {
  const Image pixel{1, 1, {10, 20, 30}};
  CHECK(turned_image(pixel, 33).rgb == pixel.rgb);
  CHECK(turned_image(Image{2, 3, std::vector<std::uint8_t>(18, 9)}, 33).rgb == std::vector<std::uint8_t>(12, 9));
  CHECK_THROWS_WITH(turned_image(Image{}, 0), "[frame] the image is empty: 0x0 pixels");
  CHECK_THROWS_WITH(mirrored(Image{1, 1, {}}), "[frame] the image of 1x1 pixels has 0 values, expected 3");
  CHECK_THROWS_WITH(turned_image(pixel, std::numeric_limits<double>::infinity()),
                    Catch::Contains("[frame] the angle of the camera is not finite"));
}
