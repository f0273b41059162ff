// The k best views, the margin over the top view, and grids, of the C interface.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "loaded_model.h"
#include "predict/view_choice.h"
#include "view/pose_grid.h"

using namespace svnet;
using namespace svnet::view;

namespace {

void refused(svnet_status status, const std::string& text) {
  CHECK(status == SVNET_INVALID_ARGUMENT);
  CHECK(std::string(svnet_last_error()) == text);
}

}  // namespace

TEST_CASE("the best views differ enough, and are those of the C++ classes") {
  const Loaded loaded;
  const std::vector<float> features = loaded.embed(small_image().rgb, 70, 50, 150, SVNET_RGB8);
  const std::vector<CameraPose> poses = fibonacci_half_sphere(200, 5);
  const std::vector<double> pairs = pairs_of(poses);
  std::vector<float> all(poses.size());
  REQUIRE(svnet_score(loaded.model, features.data(), pairs.data(), poses.size(), all.data()) == SVNET_OK);

  std::array<std::size_t, 4> indices{}, expected{};
  std::array<float, 4> scores{};
  std::size_t found = 0;
  REQUIRE(svnet_best_views(loaded.model, features.data(), pairs.data(), poses.size(), 4, 30, indices.data(),
                           scores.data(), &found) == SVNET_OK);
  REQUIRE(found == predict::best_views(all, poses, 30, expected));
  CHECK(indices == expected);
  for (std::size_t i = 0; i < found; ++i) {
    CHECK(scores[i] == all[indices[i]]);
    for (std::size_t other = 0; other < i; ++other)
      CHECK(angle_between_deg(poses[indices[i]], poses[indices[other]]) >= 30 - 1e-4);
  }
  // All fit into room for as many as there are poses.
  std::vector<std::size_t> order(poses.size());
  REQUIRE(svnet_best_views(loaded.model, features.data(), pairs.data(), poses.size(), 1000000, 0, order.data(), nullptr,
                           &found) == SVNET_OK);
  CHECK(found == poses.size());
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i) CHECK(order[i] == i);

  float margin = 9, top = 0;
  const double above[] = {90, 90};
  REQUIRE(svnet_score(loaded.model, features.data(), above, 1, &top) == SVNET_OK);
  REQUIRE(svnet_margin(loaded.model, features.data(), pairs.data(), poses.size(), &margin) == SVNET_OK);
  CHECK(margin == *std::max_element(all.begin(), all.end()) - top);
  REQUIRE(svnet_margin(loaded.model, features.data(), above, 1, &margin) == SVNET_OK);
  CHECK(margin == 0);
}

TEST_CASE("wrong arguments of choices are reported and do not change the outputs") {
  const Loaded loaded;
  svnet_model* const m = loaded.model;
  const std::vector<float> features(svnet_feature_count(m), 0.5f);
  const double poses[] = {0, 45, 90, 60};
  std::size_t index = 7, found = 8;
  float margin = 9;
  const auto views = [&](std::size_t count, std::size_t k, double angle) {
    return svnet_best_views(m, features.data(), poses, count, k, angle, &index, nullptr, &found);
  };
  refused(views(0, 1, 30), "[svnet_best_views] count is 0, there is no pose to choose from");
  refused(views(2, 0, 30), "[views] 0 views are to be chosen, expected at least one");
  refused(views(2, 1, 181), "[views] the views are to differ by 181 degrees, expected 0 to 180");
  refused(views(2, 1, std::numeric_limits<double>::quiet_NaN()),
          "[views] the views are to differ by nan degrees, expected 0 to 180");
  refused(svnet_best_views(m, features.data(), poses, 2, 1, 30, nullptr, nullptr, &found),
          "[svnet_best_views] indices is NULL");
  refused(svnet_best_views(m, features.data(), poses, 2, 1, 30, &index, nullptr, nullptr),
          "[svnet_best_views] found is NULL");
  refused(svnet_margin(m, features.data(), poses, 0, &margin),
          "[svnet_margin] count is 0, there is no pose to choose from");
  refused(svnet_margin(m, features.data(), poses, 1, nullptr), "[svnet_margin] margin is NULL");
  refused(svnet_margin(nullptr, features.data(), poses, 1, &margin), "[svnet_margin] model is NULL");
  svnet_gain_estimate gain{1, 2, 3, 4};
  refused(svnet_gain(m, features.data(), poses, 0, &gain), "[svnet_gain] count is 0, there is no pose to choose from");
  refused(svnet_gain(m, features.data(), poses, 1, nullptr), "[svnet_gain] gain is NULL");
  refused(svnet_gain(m, features.data(), poses, 1, &gain),
          "[predict] the model does not say what moving the camera gains: it was made by an earlier version, or in the "
          "frame camera; train one in another frame (sv_net.frame)");
  CHECK((index == 7 && found == 8 && margin == 9 && gain.expected == 1 && gain.probability == 4));
}

TEST_CASE("a grid is counted, then written") {
  std::size_t count = 0;
  REQUIRE(svnet_grid(4, 3, 30, 90, nullptr, 0, &count) == SVNET_OK);
  CHECK(count == 9);
  std::vector<double> poses(2 * count);
  REQUIRE(svnet_grid(4, 3, 30, 90, poses.data(), count, &count) == SVNET_OK);
  CHECK(poses == pairs_of(pose_grid({4, 3, 30, 90})));

  count = 5;
  const std::vector<double> untouched = poses;
  refused(svnet_grid(4, 3, 30, 90, poses.data(), 8, &count),
          "[svnet_grid] the grid has 9 poses, the buffer has room for 8");
  refused(svnet_grid(0, 3, 30, 90, poses.data(), 9, &count), "[view] a grid of 0 theta steps, expected 1 to 3600");
  refused(svnet_grid(4, 3, 30, 90, poses.data(), 9, nullptr), "[svnet_grid] count is NULL");
  CHECK(count == 5);
  CHECK(poses == untouched);
}
