#include "frame/silhouette.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/error.h"
#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

/// The cells whose middle lies in the shape.
Grid<std::uint8_t> cells_of(const Shape& shape) {
  Grid<std::uint8_t> cells;
  for (Index row = 0; row < kSide; ++row)
    for (Index column = 0; column < kSide; ++column)
      cells.push_back(
          shape(static_cast<double>(half_cells(column)) / kSide, static_cast<double>(half_cells(row)) / kSide) ? 1 : 0);
  return cells;
}

/// Intersection over union.
double overlap(const Grid<std::uint8_t>& a, const Grid<std::uint8_t>& b) {
  double both = 0, either = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += (a[i] & b[i]) != 0 ? 1 : 0;
    either += (a[i] | b[i]) != 0 ? 1 : 0;
  }
  return both / either;
}

Index area_of(const Grid<std::uint8_t>& cells) { return std::count(cells.begin(), cells.end(), 1); }

}  // namespace

TEST_CASE("the silhouette of colours is the object, whatever gradient, noise or shadow the table has") {
  const Shape shape = GENERATE(ellipse(1.2, 0.5, 30), wedge(1.2, 0.6, 70), letter_t(1.2, 200));
  const Look look = GENERATE(Look{}, Look{.gradient = 60}, Look{.noise = 8}, Look{.shadow = 0.35},
                             Look{.gradient = -50, .noise = 4, .shadow = 0.25}, Look{.noise = 0});
  CAPTURE(look.gradient, look.noise, look.shadow);
  CHECK(overlap(silhouette_of(picture_of(shape, look)).inside, cells_of(shape)) > 0.88);
}

TEST_CASE("only the centred square of an image is looked at") {
  const Shape shape = letter_t(1.2, 40);
  const Grid<std::uint8_t> square = silhouette_of(picture_of(shape, {.noise = 0})).inside;
  const Grid<std::uint8_t> wide = silhouette_of(picture_of(shape, {.width = 320, .gradient = 20, .noise = 0})).inside;
  const Grid<std::uint8_t> high = silhouette_of(picture_of(shape, {.height = 301, .width = 151, .noise = 0})).inside;
  CHECK(overlap(wide, square) > 0.97);
  CHECK(overlap(high, square) > 0.9);
}

TEST_CASE("images smaller and larger than the grid give the same silhouette") {
  const Shape shape = letter_t(1.2, 40);
  const Grid<std::uint8_t> expected = cells_of(shape);
  for (const Index side : {97, 112, 256, 500}) {
    CAPTURE(side);
    CHECK(overlap(silhouette_of(picture_of(shape, {.height = side, .width = side})).inside, expected) > 0.88);
  }
}

TEST_CASE("a quarter-turned image has the quarter-turned silhouette, cell by cell") {
  const unsigned seed = GENERATE(1, 2, 3);
  Image image = picture_of(wedge(1.2, 0.6, 25), {.height = 199, .width = 199, .noise = 9, .shadow = 0.3, .seed = seed});
  Grid<std::uint8_t> silhouette = silhouette_of(image).inside;
  REQUIRE(area_of(silhouette) > 500);
  for (int turn = 0; turn < 4; ++turn) {
    image = quarter_turned(image);
    silhouette = quarter_turned(silhouette);
    CHECK(silhouette_of(image).inside == silhouette);
  }
}

TEST_CASE("specks are dropped, small holes filled, large ones kept") {
  const Shape disc = ellipse(1, 1, 0);
  const auto with_hole = [&](double diameter) {
    return [=](double x, double y) { return disc(x, y) && !ellipse(diameter, diameter, 0)(x, y); };
  };
  const Shape speck = ellipse(0.06, 0.06, 0, 0.6, 0.4);
  const Look clean{.gradient = 0, .noise = 1};
  const Index disc_area = area_of(silhouette_of(picture_of(disc, clean)).inside);
  CHECK(area_of(silhouette_of(picture_of(any_of({disc, speck}), clean)).inside) == Approx(disc_area).margin(8));
  CHECK(area_of(silhouette_of(picture_of(with_hole(0.2), clean)).inside) == Approx(disc_area).margin(8));
  CHECK(area_of(silhouette_of(picture_of(with_hole(0.6), clean)).inside) == Approx(0.64 * disc_area).epsilon(0.1));
}

TEST_CASE("a table without an object has an empty silhouette") {
  const Shape nothing = [](double, double) { return false; };
  for (const double noise : {0, 3, 10}) {
    CAPTURE(noise);
    CHECK(area_of(silhouette_of(picture_of(nothing, {.gradient = 40, .noise = noise})).inside) == 0);
  }
  CHECK(area_of(silhouette_of(Image{64, 64, std::vector<std::uint8_t>(64 * 64 * 3)}).inside) == 0);
}

TEST_CASE("the silhouette of depth is what stands above the table, tilted or not") {
  const Shape shape = letter_t(1.2, 40);
  const double tilt_m = GENERATE(0.0, 0.03);
  const DepthImage depth = depth_of(
      shape, [](double, double) { return 0.02; }, tilt_m);
  const Grid<std::uint8_t> silhouette = silhouette_of(depth).inside;
  CHECK(overlap(silhouette, cells_of(shape)) > 0.9);
  CHECK(silhouette_of(quarter_turned(depth)).inside == quarter_turned(silhouette));
}

TEST_CASE("a mask becomes cells of the inscribed circle that it covers by half") {
  const Shape shape = ellipse(1.2, 0.5, 30);
  std::vector<std::uint8_t> mask;
  for (Index row = 0; row < 224; ++row)
    for (Index column = 0; column < 224; ++column)
      mask.push_back(shape((static_cast<double>(column) - 111.5) / 112, (static_cast<double>(row) - 111.5) / 112) ? 255
                                                                                                                  : 0);
  CHECK(overlap(silhouette_of_mask(224, 224, mask).inside, cells_of(shape)) > 0.95);
  const Grid<std::uint8_t> all = silhouette_of_mask(10, 10, std::vector<std::uint8_t>(100, 1)).inside;
  CHECK(all.front() == 0);
  CHECK(area_of(all) == Approx(0.785 * kCells).epsilon(0.01));
}

TEST_CASE("images that cannot be measured are errors that say why") {
  CHECK_THROWS_WITH(silhouette_of(Image{}), "[frame] the image is empty: 0x0 pixels");
  CHECK_THROWS_WITH(silhouette_of(Image{4, 5, std::vector<std::uint8_t>(7)}),
                    "[frame] the image of 4x5 pixels has 7 values, expected 60");
  CHECK_THROWS_WITH(silhouette_of(DepthImage{}), "[frame] the depth image is empty: 0x0 pixels");
  CHECK_THROWS_WITH(silhouette_of(DepthImage{64, 64, std::vector<float>(64 * 64)}),
                    Catch::Contains("[frame] the table cannot be seen"));
  CHECK_THROWS_WITH(silhouette_of_mask(2, 2, {1}), "[frame] the mask of 2x2 pixels has 1 values, expected 4");
}
