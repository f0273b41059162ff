#include "frame/seen_shapes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "frame/turns.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::vector<float> features_of(const TopFrame& top) {
  const TopFrameValues values = to_values(top);
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("the shape of a top view is what its axis and heights say, NaN if they are not known") {
  TopFrame top{{.kind = AxisKind::found, .elongation = 0.25, .skew = 0.125, .fill = std::exp(-2.5)}, {}};
  const FrameSpec rgb{}, depth{.depth = DepthChoice::heights};
  auto numbers = shape_numbers(rgb, features_of(top));
  REQUIRE(static_cast<Index>(numbers.size()) == shape_number_count(rgb));
  CHECK(numbers[0] == Approx(-0.5));
  CHECK(numbers[1] == Approx(0.75));
  CHECK(numbers[2] == Approx(0).margin(1e-6));

  numbers = shape_numbers(depth, features_of(top));
  REQUIRE(static_cast<Index>(numbers.size()) == shape_number_count(depth));
  CHECK(std::isnan(numbers[3]));
  CHECK(std::isnan(numbers[4]));
  top.heights = {.are_known = true, .measured = 1, .height = 0.5, .width = 0.25};
  numbers = shape_numbers(depth, features_of(top));
  CHECK(numbers[3] == Approx(0.25));
  CHECK(numbers[4] == Approx(1.5));

  top.axis.kind = AxisKind::unclear;
  for (const double number : shape_numbers(rgb, features_of(top))) CHECK(std::isnan(number));
}

TEST_CASE("turns count by their mean, whichever way the object points") {
  const FrameSpec spec{.frame = FrameChoice::turned, .components = 2};
  std::vector<float> features;
  for (Index i = 0; i < kTurns * 2; ++i) features.push_back(static_cast<float>(i));
  const auto numbers = shape_numbers(spec, features);
  REQUIRE(numbers.size() == 2);
  CHECK(numbers[0] == Approx(kTurns - 1));
  CHECK(numbers[1] == Approx(kTurns));
  CHECK_THROWS_AS(shape_numbers(spec, std::span(features).first(3)), Error);
}

TEST_CASE("no top view that was seen is beyond the limit, and the farthest one is at it") {
  const std::vector<std::vector<double>> numbers{{1, 10, 5}, {3, kUnknown, 5}, {2, 14, 5}, {9, 12, 5}};
  const SeenShapes seen = seen_shapes(numbers);
  CHECK(seen.mean[0] == Approx(3.75));
  CHECK(seen.mean[1] == Approx(12));
  CHECK(seen.deviation[2] == 0);
  double farthest = 0;
  for (const auto& view : numbers) {
    CHECK(trust(seen, view) == 1);
    farthest = std::max(farthest, distance(seen, view));
  }
  CHECK(seen.limit == farthest);
}

TEST_CASE("the farther a shape is, the less it counts; what is not known does not count") {
  const SeenShapes seen{.mean = {0, 0}, .deviation = {1, 2}, .limit = 2};
  const double near[] = {2, 4}, far[] = {4, 8}, half_known[] = {kUnknown, 8}, unknown[] = {kUnknown, kUnknown};
  CHECK(distance(seen, near) == Approx(2));
  CHECK(trust(seen, near) == 1);
  CHECK(trust(seen, far) == Approx(0.5));
  CHECK(distance(seen, half_known) == Approx(4));
  CHECK(trust(seen, unknown) == 1);
  CHECK(trust({}, far) == 1);
  CHECK_THROWS_AS(seen_shapes({}), Error);
}
