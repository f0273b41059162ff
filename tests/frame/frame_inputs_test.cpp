#include "frame/frame_inputs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "frame/turns.h"

using namespace svnet;
using namespace svnet::frame;
using view::CameraPose;

namespace {

const TopFrame kTop{{.kind = AxisKind::found, .direction_deg = 20, .elongation = 0.4, .skew = 0.1, .fill = 0.1}, {}};

/// Features with made-up values of the turns.
std::vector<float> features_of(const FrameSpec& spec) {
  std::vector<float> features;
  if (has_axis(spec.frame)) {
    const TopFrameValues values = to_values(kTop);
    features.assign(values.begin(), values.end());
  }
  for (Index i = 0; i < kTurns * spec.components; ++i) features.push_back(std::sin(static_cast<float>(i + 1)));
  return features;
}

}  // namespace

TEST_CASE("a frame without turns has the pose inputs, one without an axis only the elevation's") {
  const FrameSpec axis{.frame = FrameChoice::axis, .depth = DepthChoice::heights};
  const CameraPose pose{70, 50};
  CHECK(feature_count(axis) == 15);
  const TopFrame rounded = from_values(to_values(kTop));
  CHECK(frame_inputs(axis, features_of(axis), pose) ==
        pose_inputs(rounded.axis, rounded.heights, pose, input_options(DepthChoice::heights)));
  CHECK(input_groups(axis) == pose_input_groups(input_options(DepthChoice::heights)));
  const FrameSpec turned{.frame = FrameChoice::turned, .components = 3};
  CHECK(feature_count(turned) == 48);
  CHECK(input_count(turned) == 4 + 6);
  const auto groups = input_groups(turned);
  CHECK(std::count(groups.begin(), groups.end(), InputGroup::phi) == 4);
  CHECK(std::count(groups.begin(), groups.end(), InputGroup::turned) == 6);
}

TEST_CASE("values of turns come under their weights, then times the elevation") {
  const FrameChoice choice = GENERATE(FrameChoice::turned, FrameChoice::turned_axis);
  const FrameSpec spec{.frame = choice, .components = 5};
  const std::vector<float> features = features_of(spec);
  const std::size_t start = has_axis(choice) ? 15 : 0;
  for (const CameraPose pose : {CameraPose{70, 50}, CameraPose{-3, 65}, CameraPose{90, 90}, CameraPose{0, 90}}) {
    const auto inputs = frame_inputs(spec, features, pose);
    REQUIRE(static_cast<Index>(inputs.size()) == input_count(spec));
    REQUIRE(input_groups(spec).size() == inputs.size());
    const std::size_t first = inputs.size() - 10;
    const auto weights = turn_weights(pose);
    for (std::size_t k = 0; k < 5; ++k) {
      double sum = 0;
      for (std::size_t turn = 0; turn < weights.size(); ++turn)
        sum += weights[turn] * static_cast<double>(features[start + turn * 5 + k]);
      CHECK(inputs[first + k] == Approx(sum).margin(1e-12));
      CHECK(inputs[first + 5 + k] == Approx(sum * (pose.phi_deg - 65) / 15).margin(1e-12));
    }
  }
  CHECK(frame_inputs(spec, features, {0, 90}) == frame_inputs(spec, features, {77, 90}));
}

TEST_CASE("turning the turns by a quarter and the pose with them changes nothing") {
  const FrameSpec spec{.frame = FrameChoice::turned, .components = 4};
  const std::vector<float> features = features_of(spec);
  std::vector<float> turned = features;
  std::rotate(turned.begin(), turned.end() - 4 * 4, turned.end());
  for (const double theta : {0.0, 31.0, 222.0}) {
    const auto before = frame_inputs(spec, features, {theta, 45}), after = frame_inputs(spec, turned, {theta + 90, 45});
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i] == Approx(before[i]).margin(1e-12));
  }
}

TEST_CASE("features of another frame and poses out of range are refused") {
  const FrameSpec spec{.frame = FrameChoice::turned_axis, .components = 2};
  const std::vector<float> features = features_of(spec);
  CHECK_THROWS_WITH(frame_inputs(spec, std::span(features).first(46), {0, 45}),
                    "[frame] there are 46 features of a top view, expected 47");
  CHECK_THROWS_WITH(frame_inputs(spec, features, {0, 95}), Catch::StartsWith("[frame] phi 95"));
}

TEST_CASE("trust shrinks what depends on the shape and nothing else") {
  const FrameSpec spec{.frame = FrameChoice::turned_axis, .components = 3};
  const CameraPose pose{70, 50};
  const auto all = frame_inputs(spec, features_of(spec), pose), half = frame_inputs(spec, features_of(spec), pose, 0.5);
  const auto groups = input_groups(spec);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(half[i] == all[i] * (is_of_shape(groups[i]) ? 0.5 : 1));
}
