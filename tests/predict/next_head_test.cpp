#include "predict/next_head.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "frame/top_view.h"
#include "predict/predictor.h"
#include "small_model.h"
#include "temporary_folder.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::predict;
using frame::TakenView;
using view::CameraPose;

namespace {

Model model_with_next_head() {
  Model model = small_axis_model();
  set_small_next_head(model);
  return model;
}

const Image kTop = frame::picture_of(frame::letter_t(1.2, 33));

std::vector<TakenView> taken_views() {
  return {{{45, 60}, frame::view_shape(frame::picture_of(frame::wedge(1, 0.4, 10)))}, {{90, 90}, {0.1f, 0.2f, 0.3f}}};
}

}  // namespace

TEST_CASE("a model file keeps the head of the next view, which scores by its inputs") {
  const Model model = model_with_next_head();
  const TemporaryFolder folder;
  io::write_model(folder.path() / "model.safetensors", model);
  const Predictor predictor(folder.path() / "model.safetensors");
  REQUIRE(predictor.knows_next_view());
  const Tensor features = predictor.embed(kTop);
  const auto taken = taken_views();
  const std::vector<CameraPose> poses = view::pose_grid({12, 7, 0, 90});
  REQUIRE(poses.size() > 64);  // more than are scored at once
  const std::vector<float> scores = predictor.next_scores(features, taken, poses);
  const frame::NextInputs inputs(frame_spec(model), features.values<float>(), taken);
  std::vector<double> row(static_cast<std::size_t>(frame::next_input_count(frame_spec(model))));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    inputs.write(poses[i], row);
    double logit = model.next_parameters.at("ridge/bias").data<float>()[0];
    for (std::size_t k = 0; k < row.size(); ++k)
      logit += row[k] * static_cast<double>(model.next_parameters.at("ridge/kernel").data<float>()[k]);
    CHECK(scores[i] == Approx(1 / (1 + std::exp(-logit))).margin(1e-5));
    CHECK(predictor.next_scores(features, taken, std::span(&poses[i], 1))[0] == scores[i]);
  }
  // The head of single views is another one, and both may share a workspace.
  CHECK(predictor.scores(features, poses) != scores);
  Workspace workspace;
  std::vector<float> first(poses.size()), next(poses.size());
  for (int repetition = 0; repetition < 2; ++repetition) {
    predictor.scores(features.values<float>(), poses, first, workspace);
    predictor.next_scores(features.values<float>(), taken, poses, next, workspace);
    CHECK(first == predictor.scores(features, poses));
    CHECK(next == scores);
  }
}

TEST_CASE("models that do not know, and wrong arguments, are refused") {
  const Predictor without(small_axis_model());
  CHECK_FALSE(without.knows_next_view());
  const auto taken = taken_views();
  CHECK_THROWS_WITH(without.next_scores(without.embed(kTop), taken, view::paper_grid()),
                    "[predict] the model does not know which view to take next; it must be trained with "
                    "sv_net.next_view: ridge");
  const Predictor predictor(model_with_next_head());
  const Tensor features = predictor.embed(kTop);
  CHECK_THROWS_WITH(predictor.next_scores(features, {}, view::paper_grid()), "[next] no view was taken");
  CHECK_THROWS_WITH(predictor.next_scores(Tensor::zeros({1, 3}), taken, view::paper_grid()),
                    "[predict] there are 3 features, the model expects 15");
  const CameraPose below{0, -20};
  CHECK_THROWS_AS(predictor.next_scores(features, taken, std::span(&below, 1)), Error);

  Model wrong = model_with_next_head();
  wrong.next_head = models::linear_head(5);
  wrong.next_parameters.set("ridge/kernel", small_weights({5, 1}, 1));
  const TemporaryFolder folder;
  io::write_model(folder.path() / "wrong.safetensors", wrong);
  CHECK_THROWS_WITH(io::read_model(folder.path() / "wrong.safetensors"),
                    Catch::Contains("the head of the next view does not take the 39 inputs"));
}

TEST_CASE("the next view is the best one that is apart from those taken") {
  const std::vector<CameraPose> poses{{0, 45}, {10, 45}, {90, 45}, {180, 45}};
  const std::vector<float> scores{0.9f, 0.8f, 0.3f, 0.3f};
  const std::vector<TakenView> taken{{{0, 45}, {}}};
  CHECK(next_view(scores, poses, taken, 0) == 1);
  CHECK(next_view(scores, poses, taken, 20) == 2);
  CHECK(next_view(scores, poses, taken, 61) == 3);  // 60 degrees from {90, 45}
  CHECK(next_view(scores, poses, taken, 180) == std::nullopt);
  CHECK_THROWS_AS(next_view(scores, poses, taken, 181), Error);
}
