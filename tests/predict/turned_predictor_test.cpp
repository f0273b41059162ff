#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "frame/top_view.h"
#include "frame/turned_image.h"
#include "frame/turns.h"
#include "nn/graph/run.h"
#include "predict/predictor.h"
#include "small_model.h"
#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::predict;
using frame::DepthChoice;
using frame::FrameChoice;
using view::CameraPose;

namespace {

const frame::Shape kHammer = frame::letter_t(1.2, 33);

/// Of a side that is not the network's: turning comes before resizing.
Image hammer_image(Index side = 130) { return frame::picture_of(kHammer, {.height = side, .width = side, .noise = 3}); }

DepthImage hammer_depth() {
  return frame::depth_of(kHammer, [](double x, double) { return x < 0 ? 0.03 : 0.02; });
}

std::vector<CameraPose> poses_turned_by(double angle_deg) {
  std::vector<CameraPose> poses;
  for (double theta = 0; theta < 360; theta += 30)
    for (const double phi : {0.0, 20.0, 45.0, 60.0, 75.0, 90.0}) poses.push_back({theta + angle_deg, phi});
  return poses;
}

float most_different(const std::vector<float>& a, const std::vector<float>& b) {
  REQUIRE(a.size() == b.size());
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("a model in a frame with turns scores poses by the turned images") {
  const FrameChoice choice = GENERATE(FrameChoice::turned, FrameChoice::turned_axis);
  const DepthChoice depth = choice == FrameChoice::turned ? DepthChoice::none : DepthChoice::heights;
  const Model model = small_turned_model(choice, depth);
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", model);
  const Predictor predictor(folder.path() / "model.safetensors");
  CHECK(predictor.uses_depth() == (depth == DepthChoice::heights));
  const std::size_t axis = choice == FrameChoice::turned ? 0 : 15;
  CHECK(predictor.feature_count() == static_cast<Index>(axis) + 16 * 4);

  const Image image = hammer_image(96);
  const DepthImage measured = hammer_depth();
  std::vector<float> expected;
  if (axis > 0) {
    const auto values = frame::to_values(frame::top_frame(image, &measured));
    expected.assign(values.begin(), values.end());
  }
  for (const frame::Turn& turn : frame::turns()) {
    const Image turned = frame::turned_image(image, turn.theta_deg);
    Tensor batch = Tensor::empty({1, 96, 96, 3});
    prepare(model.preprocessing, turn.is_mirrored ? frame::mirrored(turned) : turned, batch.data<float>());
    const Tensor values = run_inference(model.backbone_graph, model.backbone_parameters, {batch},
                                        {model.backbone_graph.find(model.backbone_output)})[0];
    expected.insert(expected.end(), values.data<float>(), values.data<float>() + values.size());
  }
  const Tensor features = predictor.embed(image, &measured);
  REQUIRE(features.shape() == Shape{1, predictor.feature_count()});
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(features.data<float>()[i] == Approx(expected[i]).margin(1e-4));

  const auto poses = poses_turned_by(0);
  const auto scores = predictor.scores(features, poses);
  REQUIRE(scores.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto inputs = frame::frame_inputs(frame_spec(model), features.values<float>(), poses[i]);
    double logit = model.head_parameters.at("ridge/bias").data<float>()[0];
    for (std::size_t k = 0; k < inputs.size(); ++k)
      logit += inputs[k] * static_cast<double>(model.head_parameters.at("ridge/kernel").data<float>()[k]);
    CHECK(scores[i] == Approx(1 / (1 + std::exp(-logit))).margin(1e-5));
  }
  CHECK(predictor.scores(features, {}).empty());
}

TEST_CASE("quarter turns of the object turn its scores, in frames with turns") {
  const FrameChoice choice = GENERATE(FrameChoice::turned, FrameChoice::turned_axis);
  const Index side = GENERATE(96, 130, 300);
  CAPTURE(side);
  const Predictor predictor(small_turned_model(choice));
  Image image = hammer_image(side);
  const auto expected = predictor.scores(predictor.embed(image), poses_turned_by(0));
  for (int quarter = 1; quarter < 4; ++quarter) {
    image = frame::quarter_turned(image);
    const Tensor features = predictor.embed(image);
    CHECK(most_different(predictor.scores(features, poses_turned_by(90 * quarter)), expected) < 1e-5f);
    CHECK(most_different(predictor.scores(features, poses_turned_by(0)), expected) > 1e-3f);
  }
}

TEST_CASE("the mirror image of an object has its scores at mirrored azimuths") {
  const Predictor predictor(small_turned_model());
  const Image image = hammer_image(96);
  std::vector<CameraPose> mirrored;
  for (const CameraPose& pose : poses_turned_by(0)) mirrored.push_back({180 - pose.theta_deg, pose.phi_deg});
  const auto expected = predictor.scores(predictor.embed(image), poses_turned_by(0));
  // A few pixels are rounded the other way.
  CHECK(most_different(predictor.scores(predictor.embed(frame::mirrored(image)), mirrored), expected) < 2e-3f);
  CHECK(most_different(predictor.scores(predictor.embed(image), mirrored), expected) > 5e-3f);
}

TEST_CASE("frames with turns have the same bits for any number of threads") {
  const Predictor predictor(small_turned_model(FrameChoice::turned_axis));
  const int threads_before = Parallel::shared().threads();
  std::vector<std::vector<float>> features;
  for (const int threads : {1, 2, 3, 2}) {
    Parallel::shared().resize(threads);
    const Tensor of_image = predictor.embed(hammer_image());
    const auto values = of_image.values<float>();
    features.emplace_back(values.begin(), values.end());
  }
  Parallel::shared().resize(threads_before);
  for (const auto& other : features) CHECK(other == features[0]);
}

TEST_CASE("a frame with turns and depth needs depth, and features of another length are refused") {
  const Predictor predictor(small_turned_model(FrameChoice::turned_axis, DepthChoice::heights));
  CHECK_THROWS_WITH(predictor.embed(hammer_image()), Catch::Contains("the model was trained with depth"));
  const CameraPose poses[] = {{0, 45}};
  CHECK_THROWS_WITH(predictor.scores(Tensor::zeros({1, 15}), poses),
                    "[predict] features are 1x15, the model expects 1x79 f32");
}
