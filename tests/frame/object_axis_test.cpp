#include "frame/object_axis.h"

#include <catch2/catch.hpp>
#include <string>

#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

ObjectAxis axis_in(const Image& image) { return axis_of(silhouette_of(image)); }

}  // namespace

TEST_CASE("the axis is within a degree at any angle, and points to the heavy end") {
  for (double angle = -7; angle < 360; angle += 23) {
    CAPTURE(angle);
    const Look look{.noise = 3, .shadow = 0.2};
    const ObjectAxis of_ellipse = axis_in(picture_of(ellipse(1.3, 0.4, angle), look));
    CHECK(of_ellipse.kind == AxisKind::found);
    CHECK(between_axes(of_ellipse.direction_deg, 180 + angle) < 1);
    // The right of the image, to which the shapes point at 0 degrees, is the azimuth of 180.
    for (const Shape& shape : {wedge(1.3, 0.5, angle), letter_t(1.3, angle)}) {
      const ObjectAxis axis = axis_in(picture_of(shape, look));
      CHECK(axis.kind == AxisKind::found);
      CHECK(between_directions(axis.direction_deg, 180 + angle) < 1);
    }
  }
}

TEST_CASE("the sizes of an ellipse and of a wedge are those of geometry") {
  const ObjectAxis of_ellipse = axis_in(picture_of(ellipse(1.2, 0.4, 20), {.noise = 1}));
  CHECK(of_ellipse.elongation == Approx(0.4 / 1.2).epsilon(0.03));
  CHECK(of_ellipse.skew < 0.01);
  CHECK(of_ellipse.fill == Approx(1.2 * 0.4 / 4).epsilon(0.05));  // of a circle of diameter 2
  CHECK(of_ellipse.length == Approx(0.6).epsilon(0.03));
  CHECK(of_ellipse.width == Approx(0.2).margin(0.015));  // a cell has .009
  // The centroid of a triangle lies at two thirds of its height, a sixth beyond the middle.
  const ObjectAxis of_wedge = axis_in(picture_of(wedge(1.3, 0.5, 0), {.noise = 1}));
  CHECK(of_wedge.skew == Approx(1.0 / 6).epsilon(0.1));
}

TEST_CASE("a quarter turn adds 90 degrees and changes nothing else") {
  Image image = picture_of(letter_t(1.2, 33), {.noise = 6, .shadow = 0.3});
  const ObjectAxis first = axis_in(image);
  for (int turn = 1; turn <= 4; ++turn) {
    image = quarter_turned(image);
    const ObjectAxis axis = axis_in(image);
    CAPTURE(turn);
    CHECK(axis.direction_deg >= 0);
    CHECK(axis.direction_deg < 360);
    CHECK(between_directions(axis.direction_deg, first.direction_deg + 90 * turn) < 1e-9);
    CHECK(axis.elongation == Approx(first.elongation).epsilon(1e-12));
    CHECK(axis.skew == Approx(first.skew).epsilon(1e-9));
    CHECK(axis.fill == first.fill);
    CHECK(axis.length == Approx(first.length).epsilon(1e-12));
    CHECK(axis.width == Approx(first.width).epsilon(1e-12));
  }
}

TEST_CASE("discs and squares are round") {
  CHECK(axis_in(picture_of(ellipse(1, 1, 0))).kind == AxisKind::round);
  CHECK(axis_in(picture_of(ellipse(1, 0.95, 50), {.shadow = 0.2})).kind == AxisKind::round);
  const Shape square = [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 0.4; };
  CHECK(axis_in(picture_of(square)).kind == AxisKind::round);
}

TEST_CASE("clutter, objects that are cut off, and empty tables are unclear") {
  const Shape nothing = [](double, double) { return false; };
  const Shape pair = any_of({ellipse(0.5, 0.2, 10, -0.4, 0), ellipse(0.45, 0.2, 80, 0.4, 0)});
  const Shape heap = any_of({ellipse(0.4, 0.2, 10, -0.5, 0.1), ellipse(0.4, 0.2, 70, 0.4, 0.4),
                             ellipse(0.35, 0.2, 30, 0.1, -0.55), ellipse(0.3, 0.3, 0, 0.5, -0.2)});
  const Shape cut_off = ellipse(3, 0.5, 30);
  for (const Shape& shape : {nothing, pair, heap, cut_off}) {
    const ObjectAxis axis = axis_in(picture_of(shape));
    CAPTURE(axis.fill, axis.elongation, axis.length);
    CHECK(axis.kind == AxisKind::unclear);
  }
  CHECK(axis_of(silhouette_of_mask(50, 50, std::vector<std::uint8_t>(2500, 1))).kind == AxisKind::unclear);
  const ObjectAxis empty = axis_in(picture_of(nothing));
  CHECK(empty.fill == 0);
  CHECK(empty.elongation == 1);
}

TEST_CASE("an object that is broken into near patches has an axis") {
  const Shape broken = any_of({ellipse(0.5, 0.2, 0, -0.35, 0), ellipse(0.5, 0.2, 0, 0.35, 0)});
  const ObjectAxis axis = axis_in(picture_of(broken));
  CHECK(axis.kind == AxisKind::found);
  CHECK(between_axes(axis.direction_deg, 180) < 1);
}

TEST_CASE("kinds of axes have names") {
  CHECK(std::string(name_of(AxisKind::round)) == "round");
  CHECK(enum_from_name<AxisKind>("kind", "unclear") == AxisKind::unclear);
}
