// What a page takes from a dataset and its predictions.
#include "report/collect.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "io/images/image_codecs.h"
#include "io/images/image_file.h"
#include "report/feature_map.h"
#include "report/shown_poses.h"

using namespace svnet;
using namespace svnet::report;

namespace {

/// Categories of 2 objects of one pose with 3 views: the top view and two others.
ViewDataset small_views(Index categories) {
  ViewDataset dataset;
  for (Index c = 0; c < categories; ++c) {
    dataset.categories.push_back("category" + std::to_string(c));
    for (Index o = 0; o < 2; ++o) {
      const auto pose = static_cast<Index>(dataset.poses.size()), first = static_cast<Index>(dataset.views.size());
      dataset.objects.push_back({std::to_string(o + 1), c});
      dataset.poses.push_back({"1", pose, c, first, 3, first + 2});
      for (const auto& [phi, theta] : {std::pair{45, 0}, {45, 90}, {90, 90}})
        dataset.views.push_back({.path = "",
                                 .category = c,
                                 .object = pose,
                                 .pose = pose,
                                 .phi_deg = phi,
                                 .theta_deg = theta,
                                 .top = phi == 90});
    }
  }
  return dataset;
}

}  // namespace

TEST_CASE("poses know the view with the highest prediction, and the best and worst by score") {
  const ViewDataset dataset = small_views(2);
  std::vector<ViewPrediction> predictions(12, {.predicted = 0.1, .score = 0.5, .standard_error = 0, .held_out = false});
  for (std::size_t v = 6; v < 12; ++v) predictions[v].held_out = true;
  predictions[7].predicted = 0.9;
  predictions[6].score = 0.8;
  predictions[8].score = std::nan("");
  std::vector<Index> of_dataset;
  const auto poses = shown_poses(dataset, predictions, of_dataset);
  REQUIRE(poses.size() == 2);
  CHECK(of_dataset == std::vector<Index>{2, 3});
  CHECK(poses[0].category == "category1");
  CHECK(poses[0].chosen == 1);
  CHECK(poses[0].top == 2);
  CHECK(poses[0].best == 0U);
  CHECK(poses[0].worst == 1U);
  CHECK(poses[0].mean_score == Approx(0.65));
  CHECK(poses[1].chosen == 0);  // the first among equals
}

TEST_CASE("a dozen figures are spread over the categories") {
  for (const Index categories : {1, 3, 12, 29}) {
    const ViewDataset dataset = small_views(categories);
    std::vector<Index> of_dataset;
    const auto poses =
        shown_poses(dataset, std::vector<ViewPrediction>(dataset.views.size(), {0.5, 0.5, 0, true}), of_dataset);
    const auto figures = figure_poses(poses);
    CAPTURE(categories);
    CHECK(figures.size() == static_cast<std::size_t>(std::min<Index>(12, 2 * categories)));
    CHECK(figures.front() == 0);
    CHECK(std::is_sorted(figures.begin(), figures.end()));
    CHECK(std::adjacent_find(figures.begin(), figures.end()) == figures.end());
  }
  CHECK(figure_poses({}).empty());
}

TEST_CASE("the silhouette is 1 for groups far apart, and about 0 for groups on top of each other") {
  Parallel two(2);
  const std::vector<float> apart{0, 0.01F, 100, 100.01F}, mixed{0, 1, 0, 1};
  CHECK(mean_silhouette(apart, 1, {0, 0, 1, 1}, two) == Approx(1).margin(1e-3));
  CHECK(mean_silhouette(mixed, 1, {0, 0, 1, 1}, two) == Approx(-0.5));
  CHECK(std::isnan(mean_silhouette(apart, 1, {0, 0, 0, 0}, two)));
}

TEST_CASE("a feature map has both sets of views in the same axes") {
  const ViewDataset dataset = small_views(3);
  Features features;
  features.backbone = "net";
  features.count = 18;
  features.dimension = 3;
  MappedViews views;
  for (Index p = 0; p < 6; ++p) {
    views.top.push_back(3 * p + 2);
    views.chosen.push_back(3 * p);
  }
  for (int v = 0; v < 18; ++v)
    for (int d = 0; d < 3; ++d)
      features.values.push_back(static_cast<float>((v / 6 == d ? (v % 3 == 0 ? 5 : 1) : 0) + 0.1 * ((v * 7 + d) % 5)));
  Parallel two(2);
  const auto map = feature_map(dataset, features, views, 0, two);
  REQUIRE(map);
  CHECK(map->categories == dataset.categories);
  CHECK(map->top.size() == 6);
  CHECK(map->chosen[5].group == 2);
  CHECK(map->chosen_silhouette > map->top_silhouette);
  std::fill(features.values.begin(), features.values.end(), 1.0F);
  CHECK_FALSE(feature_map(dataset, features, views, 0, two));
}

TEST_CASE("an image becomes a JPEG file that decodes to nearly the same pixels") {
  Image image{20, 30, {}};
  for (int i = 0; i < 20 * 30; ++i)
    for (int c = 0; c < 3; ++c) image.rgb.push_back(static_cast<std::uint8_t>(60 * c + i / 10));
  const std::string file = io::encoded_jpeg(image, 90);
  const Image decoded = io::decode_jpeg("test", {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
  REQUIRE(decoded.rgb.size() == image.rgb.size());
  for (std::size_t i = 0; i < image.rgb.size(); ++i) CHECK(std::abs(decoded.rgb[i] - image.rgb[i]) < 12);
}
