#include "train/gain_fit.h"

#include <catch2/catch.hpp>

#include "base/random.h"
#include "predict/gain.h"
#include "train/head_fit.h"
#include "train/stages/gain_check.h"

using namespace svnet;
using namespace svnet::train;

namespace {

/// Poses of eight categories with five views each; the top view is the last. Scores are a line in one input, plus
/// noise.
PoseExamples line_examples(double noise) {
  RandomStream random(5, Stream::weights);
  PoseExamples e{.inputs = 1};
  for (std::int32_t pose = 0; pose < 160; ++pose)
    for (int view = 0; view < 5; ++view) {
      e.x.push_back(random.normal());
      e.y.push_back(0.1 * e.x.back() + noise * random.normal());
      e.weight.push_back(1);
      e.pose.push_back(pose);
      e.category.push_back(pose % 8);
      e.top.push_back(view == 4 ? 1 : 0);
    }
  return e;
}

}  // namespace

TEST_CASE("gains are those of the best predicted view over the top view") {
  PoseExamples e{
      .inputs = 1, .y = {0.1, 0.4, 0.2, 0.3, 0.9, 0.5}, .pose = {0, 0, 0, 1, 1, 2}, .top = {0, 0, 1, 1, 0, 0}};
  const auto gains = gains_of(e, std::vector<double>{0, 3, 1, 2, 1, 0});
  REQUIRE(gains.size() == 1);  // in pose 1 the top view is the best, pose 2 has none
  CHECK(gains[0].margin == 2);
  CHECK(gains[0].gain == Approx(0.2));
}

TEST_CASE("a gain that the margin tells is expected, one that it does not tell is the mean") {
  const PoseExamples e = line_examples(0.001);
  const HeadFit head = fit_head(e, {.small_penalty = {true}}, HeadChoice::ridge);
  const GainCalibration gain = gain_of_left_out(e, e.y, {.small_penalty = {true}}, head);
  CHECK(gain.slope == Approx(1).margin(0.02));
  CHECK(gain.intercept == Approx(0).margin(0.01));
  CHECK(gain.residuals.back() < 0.02);

  std::vector<PoseGain> unrelated;
  for (int i = 0; i < 20; ++i) unrelated.push_back({i % 2 == 0 ? 0.1 : 0.2, i % 2 == 0 ? 0.3 : 0.1});
  const GainCalibration flat = fitted_gain(unrelated);
  CHECK(flat.slope == 0);
  CHECK(flat.intercept == Approx(0.2));
  CHECK(fitted_gain(std::span(unrelated).first(9)).residuals.empty());
}

TEST_CASE("intervals hold what they say for other poses, and probabilities are shares") {
  PoseExamples e = line_examples(0.1);
  const HeadFit head = fit_head(e, {.small_penalty = {true}}, HeadChoice::ridge);
  const GainCalibration calibration = gain_of_left_out(e, e.y, {.small_penalty = {true}}, head);
  REQUIRE(calibration.residuals.size() > 2);
  std::vector<CheckedGain> gains;
  for (const PoseGain& g : gains_of(e, predictions(head, e)))
    gains.push_back({predict::expected_gain(calibration, g.margin), g.gain});
  const GainCheck check = checked(gains);
  CHECK(check.poses > 110);
  CHECK(check.inside == Approx(0.8).margin(0.06));
  CHECK(check.probability == Approx(check.positive).margin(0.06));
  CHECK(check.expected == Approx(check.gained).margin(0.03));
  Index poses = 0;
  for (const GainCheck::Bin& bin : check.bins) poses += bin.poses;
  CHECK(poses == check.poses);
}

TEST_CASE("gains are not known without top views or with two categories") {
  PoseExamples e = line_examples(0.1);
  const HeadFit head = fit_head(e, {.small_penalty = {true}}, HeadChoice::ridge);
  for (auto& category : e.category) category %= 2;
  CHECK(gain_of_left_out(e, e.y, {.small_penalty = {true}}, head).residuals.empty());
  e.top.clear();
  CHECK(gain_of_left_out(e, e.y, {.small_penalty = {true}}, head).residuals.empty());
}
