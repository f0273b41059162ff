#include "frame/top_frame.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "top_view.h"

using namespace svnet;
using namespace svnet::frame;

namespace {

TopFrame measured_wedge() {
  const Shape shape = wedge(1.3, 0.5, 25);
  const DepthImage depth = depth_of(shape, [](double, double) { return 0.03; });
  return top_frame(picture_of(shape), &depth);
}

}  // namespace

TEST_CASE("a top view is measured in colour, or in depth, which heights need") {
  const Shape shape = wedge(1.3, 0.5, 25);
  const TopFrame coloured = top_frame(picture_of(shape)), measured = measured_wedge();
  for (const TopFrame& top : {coloured, measured}) {
    CHECK(top.axis.kind == AxisKind::found);
    CHECK(between_directions(top.axis.direction_deg, 180 + 25) < 3);
  }
  CHECK_FALSE(coloured.heights.are_known);
  CHECK(measured.heights.are_known);
  CHECK(measured.heights.height > 0.05);
}

TEST_CASE("the values of a top view give it back, rounded to floats") {
  const TopFrame top = measured_wedge();
  const TopFrameValues values = to_values(top);
  const TopFrame back = from_values(values);
  CHECK(to_values(back) == values);
  CHECK(back.axis.kind == top.axis.kind);
  CHECK(back.axis.direction_deg == Approx(top.axis.direction_deg));
  CHECK(back.axis.width == Approx(top.axis.width));
  CHECK(back.heights.are_known);
  CHECK(back.heights.measured == Approx(top.heights.measured));
  CHECK(back.heights.volume == Approx(top.heights.volume));
  CHECK(to_values(from_values(to_values(TopFrame{}))) == to_values(TopFrame{}));
}

TEST_CASE("values that no top view has are refused") {
  const TopFrameValues good = to_values(measured_wedge());
  const auto with = [&](std::size_t index, float value) {
    TopFrameValues values = good;
    values[index] = value;
    return values;
  };
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  CHECK_THROWS_WITH(from_values(with(3, std::nanf(""))), "[frame] value 3 of a top view is nan, not a finite number");
  CHECK_THROWS_WITH(from_values(with(14, kInfinity)), "[frame] value 14 of a top view is inf, not a finite number");
  CHECK_THROWS_WITH(from_values(with(0, 3)), "[frame] value 0 of a top view is 3, expected 0, 1 or 2");
  CHECK_THROWS_WITH(from_values(with(0, 0.5f)), "[frame] value 0 of a top view is 0.5, expected 0, 1 or 2");
  CHECK_THROWS_WITH(from_values(with(7, -1)), "[frame] value 7 of a top view is -1, expected 0 or 1");
}

TEST_CASE("there are as many pose inputs as names of them") {
  for (const DepthChoice depth : {DepthChoice::none, DepthChoice::heights}) {
    const PoseInputOptions options = input_options(depth);
    CHECK(pose_input_count(options) == static_cast<Index>(pose_input_names(options).size()));
  }
  CHECK(pose_input_count(input_options(DepthChoice::heights)) > pose_input_count(input_options(DepthChoice::none)));
}
