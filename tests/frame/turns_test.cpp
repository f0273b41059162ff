#include "frame/turns.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "frame/turned_image.h"
#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

/// The turn at this azimuth.
std::size_t turn_at(double theta_deg) {
  const auto all = turns();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Turn& turn) {
    return std::abs(std::remainder(turn.theta_deg - theta_deg, 360)) < 1e-9;
  });
  REQUIRE(at != all.end());
  return static_cast<std::size_t>(at - all.begin());
}

int most_different(const Image& a, const Image& b) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  int most = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  return most;
}

Image letter(Index side) { return picture_of(letter_t(1.2, 33), {.height = side, .width = side}); }

}  // namespace

TEST_CASE("turns are 22.5 degrees apart, and the mirrored ones are the mirror images of the others") {
  const auto all = turns();
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i].theta_deg == 11.25 + 22.5 * static_cast<double>(i));
    CHECK(all[i].is_mirrored == (i % 2 == 1));
    CHECK(all[turn_at(-all[i].theta_deg)].is_mirrored != all[i].is_mirrored);
  }
}

TEST_CASE("the images of the turns are turned images, mirrored if the turn is") {
  const Index side = GENERATE(64, 65);
  const Image image = letter(side);
  const auto images = turned_images(image, side);
  REQUIRE(images.size() == kTurns);
  for (std::size_t i = 0; i < images.size(); ++i) {
    CAPTURE(side, i);
    const Image turned = turned_image(image, turns()[i].theta_deg);
    CHECK(images[i].rgb == (turns()[i].is_mirrored ? mirrored(turned) : turned).rgb);
  }
}

TEST_CASE("an image turned by a quarter, or mirrored, has the same images at other turns") {
  const Index side = GENERATE(64, 65, 150), wanted = 64;
  const Image image = letter(side);
  const auto images = turned_images(image, wanted), quarter = turned_images(quarter_turned(image), wanted),
             mirror = turned_images(mirrored(image), wanted);
  for (std::size_t i = 0; i < images.size(); ++i) {
    CAPTURE(side, i);
    CHECK(images[i].height == wanted);
    CHECK(quarter[turn_at(turns()[i].theta_deg + 90)].rgb == images[i].rgb);
    // Sums of a row are taken in the other direction.
    CHECK(most_different(mirror[turn_at(180 - turns()[i].theta_deg)], images[i]) <= 1);
  }
}

TEST_CASE("smaller images keep their size, and large ones are reduced to the mean of their pixels") {
  CHECK(turned_images(letter(40), 64)[3].height == 40);
  const Image even{4, 6, std::vector<std::uint8_t>(4 * 6 * 3, 77)};
  for (const Image& image : turned_images(even, 2)) CHECK(image.rgb == std::vector<std::uint8_t>(12, 77));
  CHECK_THROWS_WITH(turned_images(even, 0), "[frame] turned images are to have 0 pixels");
  CHECK_THROWS_WITH(turned_images(Image{}, 8), "[frame] the image is empty: 0x0 pixels");
}

TEST_CASE("weights of turns interpolate linearly, half of them among mirrored turns") {
  for (const double theta : {-360.0, -17.0, 0.0, 11.25, 30.0, 33.75, 101.0, 356.0, 720.0}) {
    CAPTURE(theta);
    const auto weights = turn_weights({theta, 45});
    double as_seen = 0, in_mirror = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double away = std::abs(std::remainder(turns()[i].theta_deg - theta, 360));
      CHECK(weights[i] == Approx(std::max(0.0, 1 - away / 45) / 2).margin(1e-12));
      (turns()[i].is_mirrored ? in_mirror : as_seen) += weights[i];
    }
    CHECK(as_seen == Approx(0.5));
    CHECK(in_mirror == Approx(0.5));
  }
}

TEST_CASE("weights turn by quarters and mirror with the azimuth") {
  for (const double theta : {0.0, 7.0, 100.0, 200.0}) {
    CAPTURE(theta);
    const auto weights = turn_weights({theta, 30}), quarter = turn_weights({theta + 90, 30}),
               mirror = turn_weights({-theta, 30}), whole = turn_weights({theta - 360, 30});
    for (std::size_t i = 0; i < weights.size(); ++i) {
      CHECK(quarter[turn_at(turns()[i].theta_deg + 90)] == Approx(weights[i]).margin(1e-12));
      CHECK(mirror[turn_at(-turns()[i].theta_deg)] == Approx(weights[i]).margin(1e-12));
      CHECK(whole[i] == Approx(weights[i]).margin(1e-12));
    }
  }
}

TEST_CASE("the top view sees the mean of all turns, at any azimuth") {
  for (const double theta : {0.0, 90.0, 123.0})
    for (const double weight : turn_weights({theta, 90})) CHECK(weight == 1.0 / 16);
}
