// Contexts give the results of calls without one, from several threads, again and again.
#include <array>
#include <catch2/catch.hpp>
#include <thread>

#include "frame/top_view.h"
#include "loaded_model.h"
#include "view/pose_grid.h"

using namespace svnet;

namespace {

struct Context {
  explicit Context(const svnet_model* model) { REQUIRE(svnet_context_create(model, &context) == SVNET_OK); }
  ~Context() { svnet_context_free(context); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  svnet_context* context = nullptr;
};

/// What one image and one list of poses give.
struct Answer {
  std::vector<float> features, scores;
  std::size_t best = 0, found = 0;
  std::vector<std::size_t> chosen;
  float margin = 0;
  bool operator==(const Answer&) const = default;
};

Answer answer_of_model(const svnet_model* model, const Image& image, const std::vector<double>& poses) {
  const std::size_t count = poses.size() / 2;
  const auto height = static_cast<std::int32_t>(image.height), width = static_cast<std::int32_t>(image.width);
  Answer a{std::vector<float>(svnet_feature_count(model)), std::vector<float>(count), 0, 0, {0, 0, 0}};
  const float* const features = a.features.data();
  const bool done =
      svnet_embed(model, image.rgb.data(), height, width, static_cast<std::size_t>(3 * width), SVNET_RGB8,
                  a.features.data()) == SVNET_OK &&
      svnet_score(model, features, poses.data(), count, a.scores.data()) == SVNET_OK &&
      svnet_best_view(model, features, poses.data(), count, &a.best, nullptr) == SVNET_OK &&
      svnet_best_views(model, features, poses.data(), count, 3, 40, a.chosen.data(), nullptr, &a.found) == SVNET_OK &&
      svnet_margin(model, features, poses.data(), count, &a.margin) == SVNET_OK;
  if (!done) a.features.clear();
  return a;
}

Answer answer_of_context(const svnet_model* model, svnet_context* c, const Image& image,
                         const std::vector<double>& poses) {
  const std::size_t count = poses.size() / 2;
  const auto height = static_cast<std::int32_t>(image.height), width = static_cast<std::int32_t>(image.width);
  Answer a{std::vector<float>(svnet_feature_count(model)), std::vector<float>(count), 0, 0, {0, 0, 0}};
  const float* const features = a.features.data();
  const bool done = svnet_context_embed(c, image.rgb.data(), height, width, static_cast<std::size_t>(3 * width),
                                        SVNET_RGB8, nullptr, a.features.data()) == SVNET_OK &&
                    svnet_context_score(c, features, poses.data(), count, a.scores.data()) == SVNET_OK &&
                    svnet_context_best_view(c, features, poses.data(), count, &a.best, nullptr) == SVNET_OK &&
                    svnet_context_best_views(c, features, poses.data(), count, 3, 40, a.chosen.data(), nullptr,
                                             &a.found) == SVNET_OK &&
                    svnet_context_margin(c, features, poses.data(), count, &a.margin) == SVNET_OK;
  if (!done) a.features.clear();
  return a;
}

}  // namespace

TEST_CASE("a context gives the results of calls without one, for images and poses in any order") {
  Model symmetric = small_model();
  symmetric.symmetries = 8;
  for (const Model& model : {small_model(), symmetric, small_axis_model(), small_turned_model()}) {
    const Loaded loaded(model);
    const Context mine(loaded.model);
    const std::vector<double> few = pairs_of(view::paper_grid()), many = pairs_of(view::fibonacci_half_sphere(150, 0));
    for (const Image& image : {small_image(), small_image(96, 96), small_image(40, 130), small_image()})
      for (const auto& poses : {few, many, few}) {
        const Answer expected = answer_of_model(loaded.model, image, poses);
        REQUIRE(!expected.features.empty());
        CHECK(answer_of_context(loaded.model, mine.context, image, poses) == expected);
      }
  }
}

TEST_CASE("a context takes depth, and goes on after an error") {
  const Loaded loaded(small_axis_model(frame::DepthChoice::heights));
  const Context mine(loaded.model);
  const frame::Shape shape = frame::wedge(1.3, 0.5, 70);
  const Image image = frame::picture_of(shape);
  const DepthImage depth = frame::depth_of(shape, [](double, double) { return 0.03; });
  std::vector<float> expected(svnet_feature_count(loaded.model)), features(expected.size(), 0.25f);
  const std::vector<float> untouched = features;
  REQUIRE(svnet_embed_with_depth(loaded.model, image.rgb.data(), 224, 224, 672, SVNET_RGB8, depth.metres.data(),
                                 expected.data()) == SVNET_OK);
  const auto embed = [&](const float* metres, std::size_t stride) {
    return svnet_context_embed(mine.context, image.rgb.data(), 224, 224, stride, SVNET_RGB8, metres, features.data());
  };
  CHECK(embed(nullptr, 672) == SVNET_INVALID_ARGUMENT);
  CHECK_THAT(svnet_last_error(), Catch::Contains("the model was trained with depth"));
  CHECK(embed(depth.metres.data(), 600) == SVNET_INVALID_ARGUMENT);
  CHECK(std::string(svnet_last_error()) ==
        "[svnet_context_embed] stride_bytes is 600, less than the 672 bytes of a row");
  CHECK(features == untouched);
  CHECK(embed(depth.metres.data(), 672) == SVNET_OK);
  CHECK(features == expected);

  svnet_context* none = mine.context;
  CHECK(svnet_context_create(nullptr, &none) == SVNET_INVALID_ARGUMENT);
  CHECK(std::string(svnet_last_error()) == "[svnet_context_create] model is NULL");
  CHECK(none == nullptr);
  float score = 0;
  const double pose[] = {0, 45};
  CHECK(svnet_context_score(nullptr, features.data(), pose, 1, &score) == SVNET_INVALID_ARGUMENT);
  CHECK(std::string(svnet_last_error()) == "[svnet_context_score] context is NULL");
  svnet_context_free(nullptr);
}

TEST_CASE("a context that scores other features does not mix them up with the last ones") {
  const Loaded loaded;
  const Context mine(loaded.model);
  std::vector<float> first = loaded.embed(small_image().rgb, 70, 50, 150, SVNET_RGB8), second = first;
  second.back() += 1;
  const std::vector<double> poses = pairs_of(view::paper_grid());
  const auto both = [&](const std::vector<float>& features) {
    std::vector<float> alone(22), kept(22);
    REQUIRE(svnet_score(loaded.model, features.data(), poses.data(), 22, alone.data()) == SVNET_OK);
    REQUIRE(svnet_context_score(mine.context, features.data(), poses.data(), 22, kept.data()) == SVNET_OK);
    CHECK(kept == alone);
    return kept;
  };
  const std::vector<float> of_first = both(first);
  CHECK(both(second) != of_first);
  CHECK(both(first) == of_first);
}

TEST_CASE("four threads with contexts of one model get equal results") {
  const Loaded loaded;
  const Image image = small_image();
  const std::vector<double> poses = pairs_of(view::paper_grid());
  const Answer expected = answer_of_model(loaded.model, image, poses);
  REQUIRE(!expected.features.empty());
  std::array<bool, 4> equal{};
  std::vector<std::thread> threads;
  for (bool& mine : equal)
    threads.emplace_back([&] {
      svnet_context* context = nullptr;
      bool same = svnet_context_create(loaded.model, &context) == SVNET_OK;
      for (int call = 0; call < 20 && same; ++call)
        same = answer_of_context(loaded.model, context, image, poses) == expected &&
               (call % 5 != 0 || answer_of_model(loaded.model, image, poses) == expected);
      svnet_context_free(context);
      mine = same;
    });
  for (auto& thread : threads) thread.join();
  CHECK(equal == std::array{true, true, true, true});
}
