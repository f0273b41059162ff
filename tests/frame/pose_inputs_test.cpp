#include "frame/pose_inputs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"

using namespace svnet;
using namespace svnet::frame;
using svnet::view::CameraPose;

namespace {

constexpr PoseInputOptions kAll{.axis = true, .shape = true, .heights = true};
const ObjectAxis kHammer{AxisKind::found, 100, 0.3, 0.1, 0.06, 0.6, 0.2};
const Heights kHigh{true, 1, 0.2, 0.4, 0.1, 0.5, 0.3, 0.03};

std::map<std::string, double> inputs(const ObjectAxis& axis, const Heights& heights, const CameraPose& pose) {
  const std::vector<std::string> names = pose_input_names(kAll);
  const std::vector<double> values = pose_inputs(axis, heights, pose, kAll);
  REQUIRE(names.size() == values.size());
  std::map<std::string, double> result;
  for (std::size_t i = 0; i < names.size(); ++i) result[names[i]] = values[i];
  return result;
}

}  // namespace

TEST_CASE("inputs follow the formulas") {
  auto in = inputs(kHammer, kHigh, {130, 45});
  const double x = -20.0 / 15, c = std::cos(std::numbers::pi / 4), alpha = std::numbers::pi / 6;
  CHECK(in["x"] == Approx(x));
  CHECK(in["x^2-1"] == Approx(x * x - 1));
  CHECK(in["top"] == 0);
  CHECK(in["low"] == 0);
  CHECK(in["a1"] == Approx(10 * 0.1 * c * std::cos(alpha)));
  CHECK(in["a2"] == Approx(2 * 0.7 * c * std::cos(2 * alpha)));
  CHECK(in["a4"] == Approx(2 * 0.7 * c * std::cos(4 * alpha)));
  CHECK(in["a2*x"] == Approx(in["a2"] * x));
  CHECK(in["m"] == 0);
  CHECK(in["E*x"] == Approx(-0.4 * x));
  CHECK(in["S*x"] == Approx(0.5 * x));
  CHECK(in["F*x"] == Approx((std::log(0.06) + 2.5) * x));
  CHECK(in["a1*E"] == Approx(in["a1"] * -0.4));
  CHECK(in["T"] == Approx(-0.05));
  CHECK(in["W*x"] == Approx(0).margin(1e-12));
  CHECK(in["a4*T"] == Approx(in["a4"] * -0.05));
  CHECK(in["h"] == 0);
}

TEST_CASE("the top view has no azimuth, and low views are marked") {
  auto top = inputs(kHammer, kHigh, {130, 89.7});
  CHECK(top["top"] == 1);
  for (const char* name : {"a1", "a2", "a4", "a1*x", "a2*F", "a4*T"}) CHECK(top[name] == 0);
  CHECK(pose_inputs(kHammer, kHigh, {0, 90}, kAll) == pose_inputs(kHammer, kHigh, {77, 90}, kAll));
  CHECK(inputs(kHammer, kHigh, {0, 9})["low"] == 1);
}

TEST_CASE("turning object and camera together changes nothing") {
  ObjectAxis turned = kHammer;
  turned.direction_deg += 37;
  const auto before = pose_inputs(kHammer, kHigh, {20, 60}, kAll), after = pose_inputs(turned, kHigh, {57, 60}, kAll);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i] == Approx(before[i]).margin(1e-12));
}

TEST_CASE("what was not found is 0 and has an indicator") {
  ObjectAxis round = kHammer, unclear = kHammer;
  round.kind = AxisKind::round, unclear.kind = AxisKind::unclear;
  auto of_round = inputs(round, {}, {130, 45}), of_unclear = inputs(unclear, {}, {130, 45});
  for (const char* name : {"a1", "a2", "a4", "a1*x", "a2*E"}) {
    CHECK(of_round[name] == 0);
    CHECK(of_unclear[name] == 0);
  }
  CHECK(of_round["m"] == 1);
  CHECK(of_round["m*x"] == of_round["x"]);
  CHECK(of_round["E*x"] != 0);
  CHECK(of_unclear["E*x"] == 0);
  CHECK(of_round["T"] == 0);
  CHECK(of_round["h"] == 1);
}

TEST_CASE("each input has its own name and a group, and options leave groups out") {
  const std::vector<std::string> names = pose_input_names(kAll);
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
  const std::vector<InputGroup> groups = pose_input_groups(kAll);
  CHECK(groups.size() == names.size());
  CHECK(std::is_sorted(groups.begin(), groups.end()));
  CHECK(pose_input_names({.axis = false}) == std::vector<std::string>{"x", "x^2-1", "top", "low"});
  CHECK(pose_input_names({}).size() == 12);
  CHECK(pose_input_names({.heights = true}).size() == 26);
  for (const InputGroup group : pose_input_groups({})) CHECK((group == InputGroup::phi || group == InputGroup::axis));
  CHECK(pose_inputs({}, {}, {0, 45}, kAll).size() == names.size());
}

TEST_CASE("a pose out of range is an error") {
  CHECK_THROWS_WITH(pose_inputs(kHammer, kHigh, {0, 95}), Catch::Contains("phi 95"));
}
