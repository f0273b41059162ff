#include "frame/next_inputs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "frame/top_frame.h"
#include "frame/top_view.h"

using namespace svnet;
using namespace svnet::frame;
using view::CameraPose;

namespace {

const FrameSpec kAxis{.frame = FrameChoice::axis};

std::vector<float> features_of(double direction_deg) {
  const TopFrameValues values = to_values(
      {{.kind = AxisKind::found, .direction_deg = direction_deg, .elongation = 0.4, .skew = 0.1, .fill = 0.1}, {}});
  return {values.begin(), values.end()};
}

std::vector<double> inputs_of(std::span<const float> features, std::span<const TakenView> taken,
                              const CameraPose& pose) {
  std::vector<double> inputs(static_cast<std::size_t>(next_input_count(kAxis)));
  NextInputs(kAxis, features, taken).write(pose, inputs);
  return inputs;
}

}  // namespace

TEST_CASE("inputs of the next view are those of the candidate, its relation to the taken view and that one's shape") {
  const std::vector<float> features = features_of(20);
  const TakenView taken{{30, 45}, {0.5f, -0.25f, 1}};
  const CameraPose pose{75, 60};
  const auto inputs = inputs_of(features, std::span(&taken, 1), pose);
  const auto own = frame_inputs(kAxis, features, pose);
  REQUIRE(inputs.size() == own.size() + 6 + 9);
  CHECK(std::equal(own.begin(), own.end(), inputs.begin()));

  const double rad = std::acos(-1.0) / 180, plane = std::cos(45 * rad) * std::cos(60 * rad);
  const double angle = std::acos(plane * std::cos(45 * rad) + std::sin(45 * rad) * std::sin(60 * rad)) / rad;
  const double near = angle / 90, x = -5.0 / 15, taken_x = -20.0 / 15;
  const double expected[] = {near,
                             near * near,
                             plane * std::cos(45 * rad),
                             plane * std::cos(90 * rad),
                             0.5,
                             x * taken_x,
                             0.5 * x,
                             0.5 * near,
                             0.5 * plane * std::cos(45 * rad),
                             -0.25 * x};
  for (std::size_t i = 0; i < std::size(expected); ++i)
    CHECK(inputs[own.size() + i] == Approx(expected[i]).margin(1e-9));

  const auto groups = next_input_groups(kAxis);
  REQUIRE(groups.size() == inputs.size());
  CHECK(std::ranges::count(groups, InputGroup::relation) == 6);
  CHECK(std::ranges::count(groups, InputGroup::second) == 9);
  CHECK((!is_of_shape(InputGroup::relation) && is_of_shape(InputGroup::second)));
}

TEST_CASE("several taken views count by their mean, and all turn with the object") {
  const std::vector<float> features = features_of(20);
  const TakenView taken[] = {{{30, 45}, {0.5f, 0, 0}}, {{90, 90}, {0, 1, 0}}};
  const CameraPose pose{200, 20};
  const auto both = inputs_of(features, taken, pose), first = inputs_of(features, std::span(taken).first(1), pose),
             second = inputs_of(features, std::span(taken).last(1), pose);
  for (std::size_t i = 0; i < both.size(); ++i) CHECK(both[i] == Approx((first[i] + second[i]) / 2).margin(1e-12));

  const TakenView turned[] = {{{130, 45}, {0.5f, 0, 0}}, {{190, 90}, {0, 1, 0}}};
  const auto other = inputs_of(features_of(120), turned, {300, 20});
  for (std::size_t i = 0; i < both.size(); ++i) CHECK(other[i] == Approx(both[i]).margin(1e-5));
}

TEST_CASE("the shape of a view is that of its silhouette, zeros where there is none") {
  const ViewShape hammer = view_shape(picture_of(letter_t(1.2, 33)));
  const ObjectShape expected = shape_of(top_frame(picture_of(letter_t(1.2, 33))).axis, {});
  CHECK(hammer[0] == Approx(expected.elongation));
  CHECK(hammer[1] == Approx(expected.skew));
  CHECK(hammer[2] == Approx(expected.fill));
  CHECK(view_shape({40, 40, std::vector<std::uint8_t>(4800, 120)}) == ViewShape{});
}

TEST_CASE("what cannot have been taken is refused") {
  const std::vector<float> features = features_of(0);
  CHECK_THROWS_WITH(NextInputs(kAxis, features, {}), "[next] no view was taken");
  const TakenView below{{0, -5}, {}};
  CHECK_THROWS_WITH(NextInputs(kAxis, features, std::span(&below, 1)),
                    "[next] the pose of a taken view: phi -5 is outside [0, 90] degrees");
  const TakenView strange{{0, 5}, {0, std::numeric_limits<float>::quiet_NaN(), 0}};
  CHECK_THROWS_WITH(NextInputs(kAxis, features, std::span(&strange, 1)),
                    "[next] the shape of a taken view is not finite");
}
