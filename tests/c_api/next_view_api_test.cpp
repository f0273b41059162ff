// The next view, and the gain, with and without a context.
#include <array>
#include <catch2/catch.hpp>

#include "frame/top_view.h"
#include "loaded_model.h"
#include "predict/predictor.h"
#include "view/pose_grid.h"

using namespace svnet;

namespace {

Model model_that_knows() {
  Model model = small_axis_model();
  set_small_next_head(model);
  model.gain = {.intercept = 0.01, .slope = 0.5, .residuals = {-0.1, -0.02, 0, 0.03, 0.2}};
  return model;
}

void refused(svnet_status status, const std::string& message) {
  CHECK(status == SVNET_INVALID_ARGUMENT);
  CHECK(svnet_last_error() == message);
}

}  // namespace

TEST_CASE("svnet_next_view finds what the predictor finds, with a context too") {
  const Model model = model_that_knows();
  const Loaded loaded(model);
  CHECK(svnet_knows_next_view(loaded.model) == 1);
  const Image top = frame::picture_of(frame::letter_t(1.2, 33)), view = frame::picture_of(frame::wedge(1, 0.4, 10));
  const auto features = loaded.embed(top.rgb, 224, 224, 3 * 224, SVNET_RGB8);
  std::array<float, SVNET_VIEW_SHAPE_SIZE> shape{};
  REQUIRE(svnet_view_shape(view.rgb.data(), 224, 224, std::size_t{3} * 224, SVNET_RGB8, shape.data()) == SVNET_OK);
  CHECK(shape == frame::view_shape(view));

  const predict::Predictor predictor(model);
  const std::vector<view::CameraPose> poses = view::paper_grid();
  const std::vector<frame::TakenView> taken{{{45, 60}, shape}};
  const std::vector<float> expected = predictor.next_scores(predictor.embed(top), taken, poses);
  const auto wanted = predict::next_view(expected, poses, taken, 30);
  REQUIRE(wanted.has_value());
  const std::vector<double> pairs = pairs_of(poses);
  const double taken_deg[] = {45, 60};
  std::size_t best = 0;
  std::vector<float> scores(poses.size());
  REQUIRE(svnet_next_view(loaded.model, features.data(), taken_deg, shape.data(), 1, pairs.data(), poses.size(), 30,
                          &best, scores.data()) == SVNET_OK);
  CHECK(best == *wanted);
  CHECK(scores == expected);
  svnet_context* context = nullptr;
  REQUIRE(svnet_context_create(loaded.model, &context) == SVNET_OK);
  for (int repetition = 0; repetition < 2; ++repetition) {
    std::size_t again = 99;
    REQUIRE(svnet_context_next_view(context, features.data(), taken_deg, shape.data(), 1, pairs.data(), poses.size(),
                                    30, &again, nullptr) == SVNET_OK);
    CHECK(again == best);
    svnet_gain_estimate gain{}, in_context{};
    REQUIRE(svnet_gain(loaded.model, features.data(), pairs.data(), poses.size(), &gain) == SVNET_OK);
    REQUIRE(svnet_context_gain(context, features.data(), pairs.data(), poses.size(), &in_context) == SVNET_OK);
    CHECK((gain.expected == in_context.expected && gain.low == in_context.low && gain.high == in_context.high &&
           gain.probability == in_context.probability));
  }
  svnet_context_free(context);
  // No candidate is 180 degrees away.
  REQUIRE(svnet_next_view(loaded.model, features.data(), taken_deg, shape.data(), 1, pairs.data(), poses.size(), 180,
                          &best, nullptr) == SVNET_OK);
  CHECK(best == poses.size());
}

TEST_CASE("wrong arguments of svnet_next_view and svnet_view_shape are refused") {
  const Loaded loaded(model_that_knows()), other(small_axis_model());
  CHECK((svnet_knows_next_view(other.model) == 0 && svnet_knows_next_view(nullptr) == 0));
  const std::vector<float> features(svnet_feature_count(loaded.model), 0.0f);
  const double pose[] = {45, 60};
  const float shape[SVNET_VIEW_SHAPE_SIZE] = {};
  std::size_t best = 7;
  const auto next = [&](const svnet_model* m, const double* taken, const float* shapes, std::size_t count,
                        std::size_t candidates) {
    return svnet_next_view(m, features.data(), taken, shapes, count, pose, candidates, 0, &best, nullptr);
  };
  refused(next(nullptr, pose, shape, 1, 1), "[svnet_next_view] model is NULL");
  refused(next(loaded.model, nullptr, shape, 1, 1), "[svnet_next_view] taken_deg is NULL");
  refused(next(loaded.model, pose, nullptr, 1, 1), "[svnet_next_view] taken_shapes is NULL");
  refused(next(loaded.model, pose, shape, 0, 1),
          "[svnet_next_view] taken is 0, no view was taken; the best first one is svnet_best_view's");
  refused(next(loaded.model, pose, shape, 1, 0), "[svnet_next_view] count is 0, there is no pose to choose from");
  refused(next(other.model, pose, shape, 1, 1),
          "[predict] the model does not know which view to take next; it must be trained with sv_net.next_view: ridge");
  CHECK(best == 7);
  std::array<float, SVNET_VIEW_SHAPE_SIZE> out{1, 2, 3};
  const std::uint8_t pixel[3] = {};
  refused(svnet_view_shape(nullptr, 1, 1, 3, SVNET_RGB8, out.data()), "[svnet_view_shape] pixels is NULL");
  refused(svnet_view_shape(pixel, 1, 1, 3, SVNET_RGB8, nullptr), "[svnet_view_shape] shape is NULL");
  CHECK(out == std::array<float, SVNET_VIEW_SHAPE_SIZE>{1, 2, 3});
}
