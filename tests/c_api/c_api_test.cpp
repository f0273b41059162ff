// Compares the shared library with its classes, which are also linked into this program.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "base/version.h"
#include "frame/top_view.h"
#include "loaded_model.h"
#include "predict/predictor.h"
#include "shell.h"
#include "small_model.h"
#include "svnet/svnet.h"
#include "temporary_folder.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::predict;
using namespace svnet::view;

namespace {

/// `image` with its channels in `order` (indices of RGB; 3 is alpha) and `gap` bytes after each row but the last.
std::vector<std::uint8_t> laid_out(const Image& image, const std::vector<int>& order, std::size_t gap) {
  std::vector<std::uint8_t> bytes;
  for (Index y = 0; y < image.height; ++y) {
    for (Index x = 0; x < image.width; ++x)
      for (const int channel : order)
        bytes.push_back(channel == 3 ? static_cast<std::uint8_t>(x * 11)
                                     : image.rgb[static_cast<std::size_t>(3 * (y * image.width + x) + channel)]);
    if (y + 1 < image.height) bytes.insert(bytes.end(), gap, 0xEE);
  }
  return bytes;
}

}  // namespace

TEST_CASE("the library gives the predictor's features, scores and best view") {
  const Loaded loaded;
  const Predictor predictor(small_model());
  const Image image = small_image();
  const std::vector<CameraPose> poses = paper_grid();
  const Tensor expected = predictor.embed(image);
  const std::vector<float> expected_scores = predictor.scores(expected, poses);

  REQUIRE(svnet_feature_count(loaded.model) == static_cast<std::size_t>(predictor.feature_count()));
  const std::vector<float> features = loaded.embed(image.rgb, 70, 50, 150, SVNET_RGB8);
  CHECK(std::equal(features.begin(), features.end(), expected.data<float>()));
  std::vector<float> scores(poses.size());
  const std::vector<double> pairs = pairs_of(poses);
  REQUIRE(svnet_score(loaded.model, features.data(), pairs.data(), poses.size(), scores.data()) == SVNET_OK);
  CHECK(scores == expected_scores);
  std::size_t best = 99;
  float score = 0;
  REQUIRE(svnet_best_view(loaded.model, features.data(), pairs.data(), poses.size(), &best, &score) == SVNET_OK);
  CHECK(best == best_view(expected_scores));
  CHECK(score == expected_scores[best]);
  CHECK(svnet_best_view(loaded.model, features.data(), pairs.data(), 1, &best, nullptr) == SVNET_OK);
  CHECK(best == 0);
  CHECK(svnet_score(loaded.model, features.data(), nullptr, 0, nullptr) == SVNET_OK);
  CHECK(std::string(svnet_version()) == kVersion);
}

TEST_CASE("every pixel format and stride gives the same image") {
  const Loaded loaded;
  const Image image = small_image();
  const std::vector<float> expected = loaded.embed(image.rgb, 70, 50, 150, SVNET_RGB8);
  struct Case {
    svnet_pixel_format format;
    std::vector<int> order;
  };
  for (const Case& c : {Case{SVNET_RGB8, {0, 1, 2}}, Case{SVNET_BGR8, {2, 1, 0}}, Case{SVNET_RGBA8, {0, 1, 2, 3}},
                        Case{SVNET_BGRA8, {2, 1, 0, 3}}})
    for (const std::size_t gap : {0, 5}) {
      INFO("format " << c.format << ", gap " << gap);
      CHECK(loaded.embed(laid_out(image, c.order, gap), 70, 50, 50 * c.order.size() + gap, c.format) == expected);
    }
  Image grey = image;
  for (std::size_t i = 0; i < grey.rgb.size(); ++i) grey.rgb[i] = image.rgb[i / 3 * 3 + 1];
  const std::vector<float> expected_grey = loaded.embed(grey.rgb, 70, 50, 150, SVNET_RGB8);
  CHECK(expected_grey != expected);
  CHECK(loaded.embed(laid_out(image, {1}, 3), 70, 50, 53, SVNET_GRAY8) == expected_grey);
}

TEST_CASE("wrong arguments are reported and do not change the outputs") {
  const Loaded loaded;
  svnet_model* const m = loaded.model;
  const std::vector<std::uint8_t> pixels(4 * 4 * 4);
  std::vector<float> features(svnet_feature_count(m), 0.25f);
  const std::vector<float> untouched = features;
  const auto refused = [](svnet_status status, const std::string& text) {
    CHECK(status == SVNET_INVALID_ARGUMENT);
    CHECK(std::string(svnet_last_error()) == text);
  };
  const auto embed = [&](int height, int width, std::size_t stride, int format) {
    return svnet_embed(m, pixels.data(), height, width, stride, static_cast<svnet_pixel_format>(format),
                       features.data());
  };
  refused(embed(0, 4, 12, SVNET_RGB8), "[svnet_embed] the image is 0x4, expected at least one pixel");
  refused(embed(4, -1, 12, SVNET_RGB8), "[svnet_embed] the image is 4x-1, expected at least one pixel");
  refused(embed(4, 4, 11, SVNET_RGB8), "[svnet_embed] stride_bytes is 11, less than the 12 bytes of a row");
  refused(embed(4, 4, 15, SVNET_BGRA8), "[svnet_embed] stride_bytes is 15, less than the 16 bytes of a row");
  refused(embed(4, 4, 16, 7), "[svnet_embed] there is no pixel format 7");
  refused(embed(65536, 65536, 262144, SVNET_RGB8), "[svnet_embed] the image is 65536x65536, larger than 64 megapixels");
  refused(svnet_embed(m, nullptr, 4, 4, 12, SVNET_RGB8, features.data()), "[svnet_embed] pixels is NULL");
  refused(svnet_embed(nullptr, pixels.data(), 4, 4, 12, SVNET_RGB8, features.data()), "[svnet_embed] model is NULL");
  refused(svnet_embed(m, pixels.data(), 4, 4, 12, SVNET_RGB8, nullptr), "[svnet_embed] features is NULL");
  CHECK(features == untouched);

  const double rounded_pose[] = {0, 90.00000250447816}, exact_pose[] = {0, 90};
  float rounded_score = -1, exact_score = -2;
  REQUIRE(svnet_embed(m, pixels.data(), 4, 4, 12, SVNET_RGB8, features.data()) == SVNET_OK);
  REQUIRE(svnet_score(m, features.data(), rounded_pose, 1, &rounded_score) == SVNET_OK);
  REQUIRE(svnet_score(m, features.data(), exact_pose, 1, &exact_score) == SVNET_OK);
  CHECK(rounded_score == exact_score);
  const double poses[] = {0, 45, 0, 95};
  float scores[] = {-1, -1};
  std::size_t best = 7;
  refused(svnet_score(m, features.data(), poses, 2, scores), "[predict] pose 1: phi 95 is outside [0, 90] degrees");
  const double rounded[] = {0, 45, 0, 90.0002};
  refused(svnet_score(m, features.data(), rounded, 2, scores),
          "[predict] pose 1: phi 90.0002 is outside [0, 90] degrees");
  refused(svnet_score(m, features.data(), nullptr, 2, scores), "[svnet_score] poses_deg is NULL");
  refused(svnet_score(m, nullptr, poses, 1, scores), "[svnet_score] features is NULL");
  refused(svnet_score(m, features.data(), poses, 1, nullptr), "[svnet_score] scores is NULL");
  refused(svnet_best_view(m, features.data(), poses, 0, &best, nullptr),
          "[svnet_best_view] count is 0, there is no pose to choose from");
  refused(svnet_best_view(m, features.data(), poses, 1, nullptr, nullptr), "[svnet_best_view] best is NULL");

  // Angles that are out of range by rounding alone are taken for the bound.
  const double bounds[] = {720, 90, -360, 0}, rounded_out[] = {720.00005, 90.0000025, -360.00005, -0.00005};
  float at_bounds[] = {-1, -1}, at_rounded[] = {-2, -2};
  REQUIRE(svnet_score(m, features.data(), bounds, 2, at_bounds) == SVNET_OK);
  REQUIRE(svnet_score(m, features.data(), rounded_out, 2, at_rounded) == SVNET_OK);
  CHECK((at_rounded[0] == at_bounds[0] && at_rounded[1] == at_bounds[1]));

  features[1] = std::nanf("");
  refused(svnet_score(m, features.data(), poses, 1, scores), "[predict] feature 1 is nan, not a finite number");
  CHECK(scores[0] == -1);
  CHECK(best == 7);
  CHECK(svnet_score(m, untouched.data(), poses, static_cast<std::size_t>(-1), scores) == SVNET_OUT_OF_MEMORY);
  CHECK(svnet_set_threads(0) == SVNET_INVALID_ARGUMENT);
  CHECK(svnet_feature_count(nullptr) == 0);
  svnet_model_free(nullptr);
}

TEST_CASE("a model that cannot be loaded is NULL and says why") {
  const TemporaryFolder folder;
  svnet_model* model = reinterpret_cast<svnet_model*>(&model);
  const std::string none = folder.path() / "none";
  CHECK(svnet_model_load(none.c_str(), &model) == SVNET_INVALID_MODEL);
  CHECK(model == nullptr);
  CHECK_THAT(svnet_last_error(), Catch::StartsWith(none + ": cannot be read"));
  const std::string text = folder.write("text", "not a model\n");
  CHECK(svnet_model_load(text.c_str(), &model) == SVNET_INVALID_MODEL);
  CHECK_THAT(svnet_last_error(), Catch::StartsWith(text + ": "));
  CHECK(svnet_model_load(nullptr, &model) == SVNET_INVALID_ARGUMENT);
  CHECK(svnet_model_load(text.c_str(), nullptr) == SVNET_INVALID_ARGUMENT);
  const std::string endless(5000, 'x');
  CHECK(svnet_model_load(endless.c_str(), &model) == SVNET_INVALID_MODEL);
  CHECK(std::strlen(svnet_last_error()) == 1023);
}

TEST_CASE("a model that uses depth takes it, and is refused without it") {
  const Model model = small_axis_model(frame::DepthChoice::heights);
  const Loaded loaded(model);
  svnet_model* const m = loaded.model;
  CHECK(svnet_uses_depth(m) == 1);
  CHECK(svnet_uses_depth(nullptr) == 0);
  const frame::Shape shape = frame::wedge(1.3, 0.5, 70);
  const Image image = frame::picture_of(shape);
  DepthImage depth = frame::depth_of(shape, [](double, double) { return 0.03; });
  const Predictor predictor(model);
  const Tensor expected = predictor.embed(image, &depth);
  REQUIRE(svnet_feature_count(m) == static_cast<std::size_t>(expected.size()));
  std::vector<float> features(svnet_feature_count(m), 0.25f);
  const auto embed = [&](const float* metres) {
    return svnet_embed_with_depth(m, image.rgb.data(), 224, 224, 672, SVNET_RGB8, metres, features.data());
  };
  REQUIRE(embed(depth.metres.data()) == SVNET_OK);
  CHECK(std::equal(features.begin(), features.end(), expected.data<float>()));
  std::vector<float> scores(3);
  const double pairs[] = {0, 45, 90, 60, 90, 90};
  REQUIRE(svnet_score(m, features.data(), pairs, 3, scores.data()) == SVNET_OK);
  CHECK(scores == predictor.scores(expected, std::vector<CameraPose>{{0, 45}, {90, 60}, {90, 90}}));

  // Numbers that mean "not measured" are all the same.
  DepthImage holes = depth, odd = depth;
  const float values[] = {std::nanf(""), -1, std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < 2000; ++i) {
    holes.metres[i * 20] = 0;
    odd.metres[i * 20] = values[i % 3];
  }
  REQUIRE(embed(holes.metres.data()) == SVNET_OK);
  const std::vector<float> with_holes = features;
  REQUIRE(embed(odd.metres.data()) == SVNET_OK);
  CHECK(features == with_holes);

  const std::vector<float> untouched(features.size(), 0.25f);
  features = untouched;
  CHECK(svnet_embed(m, image.rgb.data(), 224, 224, 672, SVNET_RGB8, features.data()) == SVNET_INVALID_ARGUMENT);
  CHECK_THAT(svnet_last_error(), Catch::Contains("the model was trained with depth"));
  CHECK(embed(nullptr) == SVNET_INVALID_ARGUMENT);
  CHECK_THAT(svnet_last_error(), Catch::StartsWith("[svnet_embed_with_depth] depth_m"));
  CHECK(svnet_embed_with_depth(m, image.rgb.data(), 224, 224, 600, SVNET_RGB8, depth.metres.data(), features.data()) ==
        SVNET_INVALID_ARGUMENT);
  CHECK_THAT(svnet_last_error(), Catch::StartsWith("[svnet_embed_with_depth] stride_bytes is 600"));
  const std::vector<float> nothing(224 * 224, 0.0f);
  CHECK(embed(nothing.data()) == SVNET_INVALID_ARGUMENT);
  CHECK(features == untouched);
}

TEST_CASE("a model that does not use depth ignores it") {
  const Image image = small_image();
  const std::vector<float> depth(70 * 50, 0.5f);
  for (const Model& model : {small_model(), small_axis_model(), small_turned_model()}) {
    const Loaded loaded(model);
    CHECK(svnet_uses_depth(loaded.model) == 0);
    const std::vector<float> expected = loaded.embed(image.rgb, 70, 50, 150, SVNET_RGB8);
    std::vector<float> features(expected.size());
    REQUIRE(svnet_embed_with_depth(loaded.model, image.rgb.data(), 70, 50, 150, SVNET_RGB8, depth.data(),
                                   features.data()) == SVNET_OK);
    CHECK(features == expected);
  }
}

TEST_CASE("a model in a frame with turns gives the features and scores of its predictor") {
  for (const frame::FrameChoice frame : {frame::FrameChoice::turned, frame::FrameChoice::turned_axis}) {
    const Model model = small_turned_model(frame);
    const Loaded loaded(model);
    const Predictor predictor(model);
    const Image image = small_image();
    const Tensor expected = predictor.embed(image);
    const std::vector<float> features = loaded.embed(image.rgb, 70, 50, 150, SVNET_RGB8);
    REQUIRE(features.size() == static_cast<std::size_t>(expected.size()));
    CHECK(std::equal(features.begin(), features.end(), expected.data<float>()));
    std::vector<float> scores(3);
    const double pairs[] = {0, 45, 90, 60, 90, 90};
    REQUIRE(svnet_score(loaded.model, features.data(), pairs, 3, scores.data()) == SVNET_OK);
    CHECK(scores == predictor.scores(expected, std::vector<CameraPose>{{0, 45}, {90, 60}, {90, 90}}));
  }
}

TEST_CASE("each thread has its own last error, and the number of threads changes no bit") {
  const Loaded loaded;
  const std::vector<std::uint8_t> pixels = small_image().rgb;
  svnet_model* none = nullptr;
  CHECK(svnet_model_load("/nonexistent/a", &none) == SVNET_INVALID_MODEL);
  const std::string mine = svnet_last_error();
  std::string other_before = "?", other_after;
  std::thread([&] {
    other_before = svnet_last_error();
    svnet_model* model = nullptr;
    svnet_model_load("/nonexistent/b", &model);
    other_after = svnet_last_error();
  }).join();
  CHECK(other_before.empty());
  CHECK_THAT(other_after, Catch::StartsWith("/nonexistent/b"));
  CHECK(svnet_last_error() == mine);

  REQUIRE(svnet_set_threads(1) == SVNET_OK);
  const std::vector<float> one = loaded.embed(pixels, 70, 50, 150, SVNET_RGB8);
  REQUIRE(svnet_set_threads(3) == SVNET_OK);
  CHECK(loaded.embed(pixels, 70, 50, 150, SVNET_RGB8) == one);
}

TEST_CASE("the number of threads may change while other threads compute") {
  const Loaded loaded;
  const std::vector<std::uint8_t> pixels = small_image().rgb;
  const std::vector<float> expected = loaded.embed(pixels, 70, 50, 150, SVNET_RGB8);
  std::array<bool, 2> same{};
  std::vector<std::thread> others;
  for (bool& result : same)
    others.emplace_back([&] {
      result = true;
      std::vector<float> features(expected.size());
      for (int i = 0; i < 50; ++i) {
        svnet_embed(loaded.model, pixels.data(), 70, 50, 150, SVNET_RGB8, features.data());
        result = result && features == expected;
      }
    });
  for (int i = 0; i < 40; ++i) CHECK(svnet_set_threads(i % 2 == 0 ? 8 : 1) == SVNET_OK);
  for (auto& other : others) other.join();
  CHECK((same[0] && same[1]));
}

TEST_CASE("a wrong environment variable is an invalid argument, not an invalid model") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "model.safetensors";
  write_model(path, small_model());
  const auto load_with = [&](const std::string& variables) {
    return run_shell(folder.path(), variables + " " C_API_LOAD_PROBE " " + path.string()).out;
  };
  CHECK(load_with("SVNET_PRECISION=fast") == "1 none [SVNET_PRECISION] 'fast' is none of f32, bf16, int8\n");
  CHECK(load_with("SVNET_CONVOLUTION=fast") == "1 none [SVNET_CONVOLUTION] 'fast' is none of direct, winograd\n");
  CHECK(load_with("SVNET_PRECISION=f32 SVNET_CONVOLUTION=direct") == "0 model \n");
}
