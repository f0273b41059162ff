#include "train/evaluation.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "train/evaluation_text.h"

using namespace svnet;
using namespace svnet::semantics;
using namespace svnet::train;

namespace {

/// Three categories of two objects with one pose of two views. The features of view 0 of a pose are at the place of its
/// category; those of view 1, the top view, are anywhere.
struct Scene {
  ViewDataset dataset;
  std::vector<float> features;
  std::vector<std::int64_t> category, object, pose;

  Scene() {
    dataset.categories = {"a", "b", "c"};
    for (Index p = 0; p < 6; ++p) {
      dataset.objects.push_back({"o", p / 2});
      dataset.poses.push_back({"1", p, p / 2, 2 * p, 2, 2 * p + 1});
      for (Index v = 0; v < 2; ++v) {
        dataset.views.push_back({"x", p / 2, p, p, v == 0 ? 45 : 90, v == 0 ? 0 : 90, v == 1});
        features.push_back(v == 0 ? static_cast<float>(10 * (p / 2)) + 0.1f * static_cast<float>(p % 2)
                                  : std::fmod(7.3f * static_cast<float>(p), 5.0f));
        category.push_back(p / 2);
        object.push_back(p);
        pose.push_back(p);
      }
    }
  }
};

}  // namespace

TEST_CASE("a selector of the informative views clusters perfectly, and tables do not depend on threads") {
  const Scene scene;
  Parallel two(2), five(5);
  const auto distances = squared_distances(scene.features.data(), 12, 1, two);
  const ClusteringProblems problems(scene.category, scene.object, scene.pose, {});
  std::vector<double> scores(12, 0.0);
  for (std::size_t i = 0; i < 12; i += 2) scores[i] = 1.0;
  const std::vector<EvaluationPipeline> pipelines{{"line_ward", &distances, {.dimension = 1}}};
  const std::vector<Selector> selectors{
      {"top", top_views(scene.dataset)}, {"rand", {}}, {"opt_ind", best_views(scene.dataset, scores)}};
  const auto table = evaluate(scene.dataset, problems, pipelines, selectors, {.problems = 500}, two, {}, "");
  const auto same = evaluate(scene.dataset, problems, pipelines, selectors, {.problems = 500}, five, {}, "");
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t m = 0; m < 3; ++m) {
      CHECK(table.cells[0][s][m].mean == same.cells[0][s][m].mean);
      CHECK(table.cells[0][s][m].standard_error == same.cells[0][s][m].standard_error);
    }
  CHECK(table.cells[0][2][1].mean == Approx(1).margin(1e-12));
  CHECK(table.cells[0][2][2].mean == 1.0);
  CHECK(table.cells[0][0][1].mean < 0.9);
  CHECK(table.cells[0][1][1].mean > table.cells[0][0][1].mean);
  CHECK(table.cells[0][1][1].mean < 1.0);

  const std::string json = tables_json({{"training", table}});
  CHECK(json.find("\"opt_ind\"") != std::string::npos);
  CHECK(table_text(table, "Training").find("line_ward") != std::string::npos);
}

TEST_CASE("a pose without scores gets its top view") {
  const Scene scene;
  std::vector<double> scores(12, std::nan(""));
  scores[2] = 0.5;
  CHECK(best_views(scene.dataset, scores) == std::vector<std::int32_t>{1, 2, 5, 7, 9, 11});
}
