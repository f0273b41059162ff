#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <type_traits>

#include "model_writer.h"
#include "svnet/svnet.hpp"
#include "temporary_folder.h"

namespace {

svnet::ViewModel small_view_model() {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "model.safetensors";
  write_small_model(path);
  return svnet::ViewModel(path);
}

}  // namespace

TEST_CASE("the C++ interface gives what the C interface gives") {
  static_assert(std::is_nothrow_move_constructible_v<svnet::ViewModel>);
  static_assert(!std::is_copy_constructible_v<svnet::ViewModel>);
  const TemporaryFolder folder;
  const std::string path = folder.path() / "model.safetensors";
  write_small_model(path);
  const svnet::ViewModel model(path);
  svnet_model* c_model = nullptr;
  REQUIRE(svnet_model_load(path.c_str(), &c_model) == SVNET_OK);

  std::vector<std::uint8_t> grey(9 * 8);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::uint8_t>(i * 37);
  std::vector<float> c_features(svnet_feature_count(c_model));
  REQUIRE(svnet_embed(c_model, grey.data(), 9, 8, 8, SVNET_GRAY8, c_features.data()) == SVNET_OK);
  const std::vector<float> features = model.embed({grey.data(), 9, 8, SVNET_GRAY8});
  CHECK(features == c_features);
  CHECK(model.embed({grey.data(), 9, 7, SVNET_GRAY8, 8}) != features);

  const std::vector<svnet::CameraPose> poses{{0, 45}, {135, 60}, {315, 75}};
  const std::array<double, 6> pairs{0, 45, 135, 60, 315, 75};
  std::vector<float> c_scores(3);
  REQUIRE(svnet_score(c_model, c_features.data(), pairs.data(), 3, c_scores.data()) == SVNET_OK);
  CHECK(model.scores(features, poses) == c_scores);
  const svnet::BestView best = model.best_view(features, poses);
  REQUIRE(best.index < 3);
  CHECK(best.score == c_scores[best.index]);
  CHECK(best.score == *std::max_element(c_scores.begin(), c_scores.end()));
  CHECK(model.best_view(features, {{315, 75}, {0, 45}, {135, 60}}).score == Approx(best.score));
  CHECK(model.scores(features, {}).empty());
  svnet_model_free(c_model);
}

TEST_CASE("the C++ interface throws what the C interface reports") {
  const svnet::ViewModel model = small_view_model();
  const std::vector<float> features(model.feature_count(), 0.5f);
  try {
    model.scores(features, {{0, 95}});
    FAIL("accepted");
  } catch (const svnet::StatusError& error) {
    CHECK(error.status() == SVNET_INVALID_ARGUMENT);
    CHECK(std::string(error.what()) == "[predict] pose 0: phi 95 is outside [0, 90] degrees");
  }
  CHECK_THROWS_WITH(model.scores({1, 2, 3}, {{0, 45}}),
                    "there are 3 features, the model expects " + std::to_string(model.feature_count()));
  CHECK_THROWS_WITH(model.best_view(features, {}), "[svnet_best_view] count is 0, there is no pose to choose from");
  CHECK_THROWS_WITH(svnet::ViewModel("/nonexistent/model"), Catch::StartsWith("/nonexistent/model: cannot be read"));
  CHECK_THROWS_WITH(svnet::set_threads(0), Catch::Contains("threads"));
}

TEST_CASE("the C++ interface takes the depth of the top view") {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "model.safetensors";
  write_depth_model(path);
  const svnet::ViewModel model(path);
  CHECK(model.uses_depth());
  CHECK_FALSE(small_view_model().uses_depth());

  // A box on a table.
  constexpr std::int32_t kSide = 120;
  std::vector<std::uint8_t> grey(kSide * kSide, 120);
  std::vector<float> depth(kSide * kSide, 0.5f);
  for (std::int32_t row = 50; row < 70; ++row)
    for (std::int32_t column = 30; column < 95; ++column) {
      grey[static_cast<std::size_t>(row * kSide + column)] = 220;
      depth[static_cast<std::size_t>(row * kSide + column)] = 0.47f;
    }
  const svnet::ImageView image{grey.data(), kSide, kSide, SVNET_GRAY8};
  const std::vector<float> features = model.embed(image, depth);
  svnet_model* c_model = nullptr;
  REQUIRE(svnet_model_load(path.c_str(), &c_model) == SVNET_OK);
  std::vector<float> c_features(svnet_feature_count(c_model));
  CHECK(svnet_embed_with_depth(c_model, grey.data(), kSide, kSide, kSide, SVNET_GRAY8, depth.data(),
                               c_features.data()) == SVNET_OK);
  svnet_model_free(c_model);
  CHECK(features == c_features);
  CHECK(model.best_view(features, {{0, 45}, {90, 45}}).score > 0);

  CHECK_THROWS_WITH(model.embed(image), Catch::Contains("the model was trained with depth"));
  depth.pop_back();
  CHECK_THROWS_WITH(model.embed(image, depth), "there are 14399 depth values, the image has 120x120 pixels");
}

TEST_CASE("the C++ interface has grids, several best views, the margin and contexts") {
  const svnet::ViewModel model = small_view_model();
  const std::vector<svnet::CameraPose> poses = svnet::pose_grid({8, 4, 0, 90});
  REQUIRE(poses.size() == 25);
  CHECK(poses[1].theta_deg == 45);
  CHECK(poses.back().phi_deg == 90);
  CHECK_THROWS_WITH(svnet::pose_grid({0, 4, 0, 90}), "[view] a grid of 0 theta steps, expected 1 to 3600");

  std::vector<std::uint8_t> grey(9 * 8);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::uint8_t>(i * 37);
  const svnet::ImageView image{grey.data(), 9, 8, SVNET_GRAY8};
  const std::vector<float> features = model.embed(image);
  const std::vector<svnet::BestView> views = model.best_views(features, poses, 3, 50);
  REQUIRE(views.size() == 3);
  CHECK(views[0].index == model.best_view(features, poses).index);
  CHECK(views[0].score >= views[1].score);
  CHECK(model.margin(features, poses) == views[0].score - model.scores(features, {{90, 90}})[0]);
  CHECK_THROWS_WITH(model.best_views(features, {}, 3, 50),
                    "[svnet_best_views] count is 0, there is no pose to choose from");

  svnet::ViewContext first(model);
  svnet::ViewContext context(std::move(first));
  std::vector<float> kept(features.size()), scores(poses.size());
  context.embed(image, kept.data());
  CHECK(kept == features);
  context.scores(kept.data(), poses.data(), poses.size(), scores.data());
  CHECK(scores == model.scores(features, poses));
  CHECK(context.best_view(kept.data(), poses.data(), poses.size()).index == views[0].index);
  std::array<std::size_t, 3> indices{};
  CHECK(context.best_views(kept.data(), poses.data(), poses.size(), 3, 50, indices.data()) == 3);
  CHECK(indices == std::array{views[0].index, views[1].index, views[2].index});
  CHECK(context.margin(kept.data(), poses.data(), poses.size()) == model.margin(features, poses));
  CHECK_THROWS_WITH(context.embed({grey.data(), 0, 8, SVNET_GRAY8}, kept.data()),
                    "[svnet_context_embed] the image is 0x8, expected at least one pixel");

  std::string line;
  svnet::set_log([](svnet_log_level, const char* text, void* to) { *static_cast<std::string*>(to) = text; }, &line);
  svnet::set_threads(2);
  svnet::set_log(nullptr);
  CHECK(line == "threads 2");
}
