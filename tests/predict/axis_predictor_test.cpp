#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "frame/frame_inputs.h"
#include "frame/top_view.h"
#include "predict/predictor.h"
#include "small_model.h"
#include "temporary_folder.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::predict;
using frame::DepthChoice;
using view::CameraPose;

namespace {

const frame::Shape kHammer = frame::letter_t(1.2, 33);

Image hammer_image() { return frame::picture_of(kHammer, {.noise = 3}); }

DepthImage hammer_depth() {
  return frame::depth_of(kHammer, [](double x, double) { return x < 0 ? 0.03 : 0.02; });
}

std::vector<CameraPose> poses_turned_by(double angle_deg) {
  std::vector<CameraPose> poses;
  for (double theta = 0; theta < 360; theta += 30)
    for (const double phi : {0.0, 20.0, 45.0, 60.0, 75.0, 90.0}) poses.push_back({theta + angle_deg, phi});
  return poses;
}

}  // namespace

TEST_CASE("a model in the frame axis scores poses by what is measured on the top view") {
  const DepthChoice depth = GENERATE(DepthChoice::none, DepthChoice::heights);
  const Model model = small_axis_model(depth);
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", model);
  const Predictor predictor(folder.path() / "model.safetensors");
  CHECK(predictor.uses_depth() == (depth == DepthChoice::heights));
  CHECK(predictor.feature_count() == static_cast<Index>(frame::kTopFrameSize));
  const DepthImage measured = hammer_depth();
  const Tensor features = predictor.embed(hammer_image(), &measured);
  REQUIRE(features.shape() == Shape{1, predictor.feature_count()});
  const frame::TopFrame top = frame::from_values(
      frame::to_values(frame::top_frame(hammer_image(), depth == DepthChoice::none ? nullptr : &measured)));
  const auto poses = poses_turned_by(0);
  const auto scores = predictor.scores(features, poses);
  REQUIRE(scores.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto inputs = frame::pose_inputs(top.axis, top.heights, poses[i], frame::input_options(depth));
    double logit = model.head_parameters.at("ridge/bias").data<float>()[0];
    for (std::size_t k = 0; k < inputs.size(); ++k)
      logit += inputs[k] * static_cast<double>(model.head_parameters.at("ridge/kernel").data<float>()[k]);
    CHECK(scores[i] == Approx(1 / (1 + std::exp(-logit))).margin(1e-5));
  }
}

TEST_CASE("an object turned by quarter turns has its scores turned by that angle") {
  const DepthChoice choice = GENERATE(DepthChoice::none, DepthChoice::heights);
  const Predictor predictor(small_axis_model(choice));
  Image image = hammer_image();
  DepthImage depth = hammer_depth();
  const auto expected = predictor.scores(predictor.embed(image, &depth), poses_turned_by(0));
  for (int quarter = 1; quarter < 4; ++quarter) {
    image = frame::quarter_turned(image);
    depth = frame::quarter_turned(depth);
    const auto scores = predictor.scores(predictor.embed(image, &depth), poses_turned_by(90 * quarter));
    for (std::size_t i = 0; i < scores.size(); ++i) {
      INFO(quarter << " quarter turns, pose " << i);
      CHECK(std::abs(scores[i] - expected[i]) < 1e-5f);
    }
    // Without turning the poses with the object, scores differ.
    CHECK(predictor.scores(predictor.embed(image, &depth), poses_turned_by(0)) != expected);
  }
}

TEST_CASE("a model without depth ignores it, and one with depth needs it") {
  const DepthImage depth = hammer_depth();
  const Predictor without(small_axis_model()), with(small_axis_model(DepthChoice::heights));
  const auto poses = view::paper_grid();
  CHECK(without.scores(without.embed(hammer_image(), &depth), poses) ==
        without.scores(without.embed(hammer_image()), poses));
  CHECK_THROWS_WITH(with.embed(hammer_image()),
                    "[predict] the model was trained with depth; give the depth image of the top view too");
  CHECK_THROWS_WITH(with.embed(Image{}, &depth), Catch::StartsWith("[predict] the image says 0x0 pixels"));
  const DepthImage empty;
  CHECK_THROWS_AS(with.embed(hammer_image(), &empty), Error);
  const Predictor camera(small_model());
  CHECK_FALSE(camera.uses_depth());
  CHECK(camera.scores(camera.embed(small_image(), &depth), poses) == camera.scores(camera.embed(small_image()), poses));
}

TEST_CASE("a round object has scores that depend on the elevation alone") {
  const Predictor predictor(small_axis_model());
  const Tensor features = predictor.embed(frame::picture_of(frame::ellipse(0.8, 0.8, 0)));
  const CameraPose poses[] = {{0, 45}, {77, 45}, {200, 45}, {0, 75}};
  const auto scores = predictor.scores(features, poses);
  CHECK(scores[0] == scores[1]);
  CHECK(scores[0] == scores[2]);
  CHECK(scores[0] != scores[3]);
}

TEST_CASE("features that no top view has are refused") {
  const Predictor predictor(small_axis_model());
  const CameraPose poses[] = {{0, 45}};
  Tensor features = predictor.embed(hammer_image());
  features.data<float>()[0] = 7;
  CHECK_THROWS_WITH(predictor.scores(features, poses), "[frame] value 0 of a top view is 7, expected 0, 1 or 2");
  CHECK_THROWS_WITH(predictor.scores(Tensor::zeros({1, 14}), poses),
                    "[predict] features are 1x14, the model expects 1x15 f32");
}

TEST_CASE("a shape unlike those of the training counts less, and the model says so") {
  Model model = small_axis_model();
  const CameraPose poses[] = {{0, 45}, {70, 60}, {90, 90}};
  const Image image = hammer_image();
  const Predictor sure(model);
  const Tensor features = sure.embed(image);
  CHECK(sure.familiarity(features).trust == 1);  // a model of an earlier version does not say what it has seen

  model.seen = {.mean = {0, 0, 0}, .deviation = {0.1, 0.1, 0.1}, .limit = 1};
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", model);
  const Predictor unsure(folder.path() / "model.safetensors");
  const auto familiarity = unsure.familiarity(features);
  CHECK(familiarity.limit == 1);
  CHECK(familiarity.distance > 1);
  CHECK(familiarity.trust == Approx(1 / familiarity.distance));
  const auto expected = frame::frame_inputs(frame_spec(model), features.values<float>(), poses[1], familiarity.trust);
  double logit = model.head_parameters.at("ridge/bias").data<float>()[0];
  for (std::size_t k = 0; k < expected.size(); ++k)
    logit += expected[k] * static_cast<double>(model.head_parameters.at("ridge/kernel").data<float>()[k]);
  CHECK(unsure.scores(features, poses)[1] == Approx(1 / (1 + std::exp(-logit))).margin(1e-5));
  CHECK(unsure.scores(features, poses) != sure.scores(features, poses));

  const Predictor camera(small_model());
  CHECK(camera.familiarity(camera.embed(small_image())).trust == 1);
}

TEST_CASE("a model that was calibrated says what moving the camera gains") {
  Model model = small_axis_model(DepthChoice::none);
  CHECK_FALSE(Predictor(model).knows_gain());
  CHECK_THROWS_WITH(Predictor(model).gain(0.6, 0.5), Catch::Contains("does not say what moving the camera gains"));
  model.gain = {.intercept = 0.01, .slope = 2, .residuals = {-0.1, 0, 0.1}};
  const Predictor predictor(model);
  CHECK(predictor.knows_gain());
  const Gain gain = predictor.gain(0.55, 0.5);
  CHECK(gain.expected == Approx(0.01 + 2 * centred_margin(0.55, 0.5)));
  CHECK(gain.low == Approx(gain.expected - 0.08));
  CHECK(gain.high == Approx(gain.expected + 0.08));
}
