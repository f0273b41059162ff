#include "predict/predictor.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "nn/graph/run.h"
#include "small_model.h"
#include "temporary_folder.h"
#include "view/pose_grid.h"
#include "view/symmetry.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using namespace svnet::predict;
using namespace svnet::view;

namespace {

/// Features and scores computed layer by layer from the model's file, one pose at a time.
Tensor plain_features(const Model& model, const Image& image) {
  Tensor batch = Tensor::empty({1, model.preprocessing.height, model.preprocessing.width, 3});
  prepare(model.preprocessing, image, batch.data<float>());
  return run_inference(model.backbone_graph, model.backbone_parameters, {batch},
                       {model.backbone_graph.find(model.backbone_output)})[0];
}

double plain_score(const Model& model, const Tensor& features, const CameraPose& pose) {
  Tensor angles = Tensor::empty({1, angle_count(model.angles)});
  encode_angles(model.angles, pose.theta_deg, pose.phi_deg, angles.data<float>());
  return run_inference(model.head, model.head_parameters, {features, angles}, {model.head.output()})[0]
      .data<float>()[0];
}

std::vector<CameraPose> many_poses() {
  std::vector<CameraPose> poses;
  for (int i = 0; i < 75; ++i) poses.push_back({i * 4.7, (i * 13) % 91 * 1.0});
  return poses;
}

}  // namespace

TEST_CASE("a predictor gives the features and scores of its model, for any number of poses") {
  for (const AngleEncoding encoding : {AngleEncoding::radians, AngleEncoding::sphere, AngleEncoding::harmonics}) {
    const Model model = small_model(encoding);
    const TemporaryFolder folder;
    const auto path = folder.path() / "model.safetensors";
    write_model(path, model);
    const Predictor predictor(path);
    const Tensor features = predictor.embed(small_image()), expected = plain_features(model, small_image());
    REQUIRE(features.shape() == Shape{1, predictor.feature_count()});
    REQUIRE(features.size() == expected.size());
    for (Index i = 0; i < features.size(); ++i)
      CHECK(features.data<float>()[i] == Approx(expected.data<float>()[i]).margin(1e-5));
    const std::vector<CameraPose> poses = many_poses();
    const std::vector<float> scores = predictor.scores(features, poses);
    REQUIRE(scores.size() == poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
      CHECK(scores[i] == Approx(plain_score(model, expected, poses[i])).margin(1e-5));
    CHECK(scores[best_view(scores)] - scores[best_first(scores).back()] > 1e-3);  // scores depend on the pose
    CHECK(predictor.scores(features, {}).empty());
  }
}

TEST_CASE("a score has the same bits whatever the other poses and the number of threads") {
  const Model camera = [] {
    Model model = small_model(AngleEncoding::harmonics);
    model.symmetries = 3;
    return model;
  }();
  std::vector<CameraPose> poses = fibonacci_half_sphere(300, 0);
  std::vector<CameraPose> reversed(poses.rbegin(), poses.rend());
  for (const Model& model : {camera, small_axis_model(), small_turned_model()}) {
    const Predictor predictor(model);
    const Tensor features = predictor.embed(small_image());
    const std::vector<float> scores = predictor.scores(features, poses);
    const std::vector<float> backwards = predictor.scores(features, reversed);
    CHECK(std::equal(scores.begin(), scores.end(), backwards.rbegin()));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      INFO("pose " << i);
      CHECK(predictor.scores(features, std::span(poses).subspan(i, 1))[0] == scores[i]);
    }
    const int threads = Parallel::shared().threads();
    for (const int other : {1, 3}) {
      Parallel::shared().resize(other);
      CHECK(predictor.scores(features, poses) == scores);
    }
    Parallel::shared().resize(threads);
  }
}

TEST_CASE("a head that cannot be split scores each pose with the whole network") {
  Model model = small_model();
  const Index dimension = element_count(model.head.node(0).shape);
  Graph head;
  const NodeId features = head.input("features", {dimension}), angles = head.input("angles", {2});
  const NodeId all = head.add("relu", ActivationLayer{}, {head.add("concat", ConcatLayer{}, {features, angles})});
  head.add("score", DenseLayer{.units = 1, .activation = Activation::sigmoid}, {all});
  model.head = head;
  model.head_parameters = initial_parameters(head, 3);
  const Predictor predictor(model);
  const Tensor embedded = predictor.embed(small_image());
  const std::vector<CameraPose> poses = many_poses();
  const std::vector<float> scores = predictor.scores(embedded, poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    CHECK(scores[i] == Approx(plain_score(model, embedded, poses[i])).margin(1e-5));
}

TEST_CASE("a model of all orientations gives their mean, in whichever orientation the image is") {
  Model model = small_model(AngleEncoding::harmonics);
  const Predictor as_taken(model);
  model.symmetries = kSymmetries;
  const Predictor predictor(model);
  CHECK(predictor.feature_count() == kSymmetries * as_taken.feature_count());

  // The image has the network's size, so that turning and resizing commute.
  const Image upright = small_image(96, 96);
  const std::vector<float> pixels(upright.rgb.begin(), upright.rgb.end());
  std::vector<float> turned(pixels.size());
  const std::vector<CameraPose> poses = many_poses();
  const std::vector<float> scores = predictor.scores(predictor.embed(upright), poses);
  std::vector<double> mean(poses.size(), 0);
  for (int symmetry = 0; symmetry < kSymmetries; ++symmetry) {
    apply_symmetry(symmetry, 96, pixels.data(), turned.data());
    const Image image{96, 96, std::vector<std::uint8_t>(turned.begin(), turned.end())};
    std::vector<CameraPose> seen;
    for (const CameraPose& pose : poses) seen.push_back({symmetric_theta_deg(symmetry, pose.theta_deg), pose.phi_deg});
    const std::vector<float> alone = as_taken.scores(as_taken.embed(image), seen);
    const std::vector<float> together = predictor.scores(predictor.embed(image), seen);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      mean[i] += alone[i] / static_cast<double>(kSymmetries);
      CHECK(together[i] == Approx(scores[i]).margin(1e-5));
    }
  }
  for (std::size_t i = 0; i < poses.size(); ++i) CHECK(scores[i] == Approx(mean[i]).margin(1e-5));
  CHECK(predictor.scores(predictor.embed(upright), std::span(poses).first(1))[0] == scores[0]);
}

TEST_CASE("poses a full turn apart have the same score") {
  const Predictor predictor(small_model());
  const Tensor features = predictor.embed(small_image());
  const std::vector<CameraPose> poses{{315, 45}, {-45, 45}, {675, 45},  {0, 60},
                                      {360, 60}, {720, 60}, {-360, 60}, {-1e-20, 60}};
  const std::vector<float> scores = predictor.scores(features, poses);
  for (const std::size_t i : {1, 2}) CHECK(scores[i] == scores[0]);
  for (const std::size_t i : {4, 5, 6, 7}) CHECK(scores[i] == scores[3]);
  CHECK(scores[0] != scores[3]);
}

TEST_CASE("in a tie the best view is the first one") {
  const std::vector<float> scores{0.25f, 0.75f, 0.5f, 0.75f, 0.25f};
  CHECK(best_view(scores) == 1);
  CHECK(best_first(scores) == std::vector<std::size_t>{1, 3, 2, 0, 4});
  CHECK_THROWS_WITH(best_view({}), "[predict] there is no pose to choose from");
}

TEST_CASE("poses out of range are refused") {
  const Predictor predictor(small_model());
  const Tensor features = predictor.embed(small_image());
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto message = [&](const CameraPose& pose) {
    try {
      predictor.scores(features, std::vector<CameraPose>{{0, 45}, pose});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(message({0, 91}) == "[predict] pose 1: phi 91 is outside [0, 90] degrees");
  CHECK(message({0, -0.5}) == "[predict] pose 1: phi -0.5 is outside [0, 90] degrees");
  CHECK(message({-361, 45}) == "[predict] pose 1: theta -361 is outside [-360, 720] degrees");
  CHECK(message({721, 45}) == "[predict] pose 1: theta 721 is outside [-360, 720] degrees");
  CHECK(message({nan, 45}) == "[predict] pose 1: theta nan is not finite");
  CHECK(message({0, infinity}) == "[predict] pose 1: phi inf is not finite");
  CHECK(message({-360, 0}) == "accepted");
  CHECK(message({720, 90}) == "accepted");
}

TEST_CASE("features and images that do not fit are refused") {
  const Predictor predictor(small_model());
  const std::vector<CameraPose> poses{{0, 45}};
  const std::string dimension = std::to_string(predictor.feature_count());
  CHECK_THROWS_WITH(predictor.scores(Tensor::zeros({1, 3}), poses),
                    "[predict] features are 1x3, the model expects 1x" + dimension + " f32");
  CHECK_THROWS_WITH(predictor.scores(Tensor(), poses),
                    "[predict] features are none, the model expects 1x" + dimension + " f32");
  Tensor features = Tensor::zeros({1, predictor.feature_count()});
  features.data<float>()[2] = std::nanf("");
  CHECK_THROWS_WITH(predictor.scores(features, poses), "[predict] feature 2 is nan, not a finite number");
  CHECK_THROWS_WITH(predictor.embed({}), "[predict] the image says 0x0 pixels and holds 0 bytes");
  // Already at the size of the network's input, so nothing is resized.
  CHECK_THROWS_WITH(predictor.embed({96, 96, std::vector<std::uint8_t>(5)}),
                    "[predict] the image says 96x96 pixels and holds 5 bytes");
  CHECK_THROWS_WITH(Predictor(std::filesystem::path("/nonexistent/model")),
                    Catch::StartsWith("/nonexistent/model: cannot be read"));
}

TEST_CASE("several threads may use one predictor") {
  const Predictor predictor(small_model());
  const auto answer = [&] { return predictor.scores(predictor.embed(small_image()), paper_grid()); };
  const std::vector<float> expected = answer();
  std::vector<std::vector<float>> answers(4);
  std::vector<std::thread> threads;
  for (auto& mine : answers) threads.emplace_back([&] { mine = answer(); });
  for (auto& thread : threads) thread.join();
  for (const auto& mine : answers) CHECK(mine == expected);
}

TEST_CASE("angles that are out of range by rounding alone score as the bound") {
  const Predictor predictor(small_model());
  const auto embedded = predictor.embed(small_image());
  const std::vector<CameraPose> exact{{0, 90}, {720, 0}}, rounded{{0, 90.00000250447816}, {720.00009, -0.0001}};
  CHECK(predictor.scores(embedded, rounded) == predictor.scores(embedded, exact));
  CHECK_THROWS_WITH(predictor.scores(embedded, std::vector<CameraPose>{{0, 90.0002}}),
                    Catch::Contains("phi 90.0002 is outside [0, 90] degrees"));
}
