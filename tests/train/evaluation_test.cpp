#include "train/evaluation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "train/evaluation_text.h"
#include "train/paper_figures.h"

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
  const auto table = evaluate(scene.dataset, {{problems, selectors}}, pipelines, {.problems = 500}, two, {}, "");
  const auto same = evaluate(scene.dataset, {{problems, selectors}}, pipelines, {.problems = 500}, five, {}, "");
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

TEST_CASE("several views of an object are clustered by their fused features") {
  // Two poses of each of three objects would be told apart by the mean of both views, not by one of them: the views of
  // object c are at 10 c - a and 10 c + a with another a for each pose.
  ViewDataset dataset;
  dataset.categories = {"a", "b", "c"};
  std::vector<std::int64_t> category, object, pose;
  std::vector<float> features;
  for (Index p = 0; p < 6; ++p) {
    dataset.poses.push_back({"1", p, p / 2, 2 * p, 2, 2 * p});
    for (Index v = 0; v < 2; ++v) {
      dataset.views.push_back({"", p / 2, p, p, v == 0 ? 90 : 45, v == 0 ? 90 : 0, v == 0});
      const float a = 9.0f * static_cast<float>(p % 2 == 0 ? 1 : -1);
      features.push_back(10 * static_cast<float>(p / 2) + (v == 0 ? a : -a) + 0.1f * static_cast<float>(p % 2));
      category.push_back(p / 2), object.push_back(p), pose.push_back(p);
    }
  }
  Parallel two(2), five(5);
  const auto distances = squared_distances(features.data(), 12, 1, two);
  const ClusteringProblems problems(category, object, pose, {});
  const std::vector<EvaluationPipeline> pipelines{{"line_ward", &distances, {.dimension = 1}}};
  std::vector<std::int32_t> both;
  for (std::int32_t v = 0; v < 12; ++v) both.push_back(v);
  const std::vector<Selector> selectors{{"top", top_views(dataset)},
                                        {"rand", {}},
                                        {"rand_2", {}, 2},
                                        {"svnet", top_views(dataset)},
                                        {"svnet_2", both, 2}};
  const EvaluationOptions options{.problems = 300, .baselines = {"top", "svnet", "rand_2"}};
  const auto table = evaluate(dataset, {{problems, selectors}}, pipelines, options, two, {}, "");
  const auto same = evaluate(dataset, {{problems, selectors}}, pipelines, options, five, {}, "");
  for (std::size_t s = 0; s < selectors.size(); ++s) CHECK(table.cells[0][s][0].mean == same.cells[0][s][0].mean);
  CHECK(table.cells[0][0][2].mean < 0.95);
  CHECK(table.cells[0][2][2].mean == 1);  // both views of each object, in any order
  CHECK(table.cells[0][4][2].mean == 1);

  const auto json = differences_json(table).at("line_ward");
  CHECK(json.contains("svnet-top"));
  CHECK(json.contains("svnet_2-svnet"));
  CHECK(json.contains("svnet_2-rand_2"));
  CHECK_FALSE(json.contains("svnet-rand_2"));
  CHECK_FALSE(json.contains("svnet-svnet"));
  CHECK(json.at("svnet_2-top").at("purity").at("mean").get<double>() > 0.05);
}

namespace {

/// A table of two pipelines, in which SV-net knows the informative views.
EvaluationTable table_with_svnet(const std::vector<std::string>& baselines = {"top", "rand"}) {
  const Scene scene;
  Parallel two(2);
  const auto distances = squared_distances(scene.features.data(), 12, 1, two);
  const ClusteringProblems problems(scene.category, scene.object, scene.pose, {.min_categories = 2});
  std::vector<double> scores(12, 0.0);
  for (std::size_t i = 0; i < 12; i += 2) scores[i] = 1.0;
  const std::vector<EvaluationPipeline> pipelines{
      {"line_ward", &distances, {.dimension = 1}},
      {"line_single", &distances, {.method = Clustering::single, .dimension = 1}}};
  const std::vector<Selector> selectors{
      {"top", top_views(scene.dataset)}, {"rand", {}}, {"svnet", best_views(scene.dataset, scores)}};
  return evaluate(scene.dataset, {{problems, selectors}}, pipelines, {.problems = 300, .baselines = baselines}, two, {},
                  "");
}

}  // namespace

TEST_CASE("differences of selectors are those of their means, and the last row is the mean over pipelines") {
  const EvaluationTable table = table_with_svnet();
  REQUIRE(table.differences.size() == 2);
  for (const auto& [baseline, column] : {std::pair<std::string, std::size_t>{"top", 0}, {"rand", 1}}) {
    const auto& rows = table.differences.at(baseline);
    REQUIRE(rows.size() == 3);
    for (std::size_t s = 0; s < 3; ++s)
      for (std::size_t m = 0; m < 3; ++m) {
        INFO(baseline << ", selector " << s << ", metric " << m);
        double mean = 0;
        for (std::size_t p = 0; p < 2; ++p) {
          const double expected = table.cells[p][s][m].mean - table.cells[p][column][m].mean;
          CHECK(rows[p][s][m].mean == Approx(expected).margin(1e-12));
          mean += expected / 2;
        }
        CHECK(rows[2][s][m].mean == Approx(mean).margin(1e-12));
        CHECK(rows[2][s][m].interval.low <= rows[2][s][m].interval.high);
        if (s == column) CHECK(rows[2][s][m].interval.high == 0);
      }
    CHECK(rows[2][2][0].mean > 0);
  }
}

TEST_CASE("selectors are compared with those baselines that the table has") {
  CHECK(table_with_svnet({"rand", "broadside"}).differences.count("rand") == 1);
  CHECK(table_with_svnet({"rand", "broadside"}).differences.size() == 1);
  CHECK_THAT(table_text(table_with_svnet({}), "x"), !Catch::Contains("minus"));
}

TEST_CASE("tables say how far SV-net is ahead, with intervals, in text and JSON") {
  const EvaluationTable table = table_with_svnet();
  const std::string text = table_text(table, "Held-out categories");
  for (const char* part : {"SV-net minus another selector, with 95 % intervals over categories", "- rand", "- top",
                           "line_single", "mean", "purity +", " [+"})
    CHECK_THAT(text, Catch::Contains(part));
  const auto json = nlohmann::json::parse(tables_json({{"held_out", table}}));
  const auto& fm = json.at("differences").at("held_out").at("line_ward").at("svnet-rand").at("fm");
  CHECK(fm.at("mean").get<double>() == Approx(table.differences.at("rand")[0][2][0].mean));
  CHECK(fm.at("low").get<double>() == Approx(table.differences.at("rand")[0][2][0].interval.low));
  CHECK(json.at("differences").at("held_out").at("mean").at("svnet-top").at("purity").at("high").is_number());
  CHECK(json.at("tables").at("held_out").at("line_ward").at("svnet").at("fm").at("standard_error").is_number());
  CHECK(json.at("tables").at("held_out").at("line_ward").at("svnet").at("fm").at("low").get<double>() ==
        Approx(table.cells[0][2][0].interval.low));
  const auto cells = nlohmann::json::parse(intervals_json(table).dump());
  CHECK(cells.at("line_single").at("rand").at("nmi").at("low").is_number());

  EvaluationTable without = table;
  without.selectors[2] = "opt_ind";
  CHECK(differences_json(without).empty());
  CHECK_FALSE(nlohmann::json::parse(tables_json({{"training", without}})).contains("differences"));
}

TEST_CASE("an interval that cannot be told is null in JSON and left out of the text") {
  EvaluationTable table = table_with_svnet();
  for (auto& row : table.differences.at("rand"))
    for (auto& selector : row)
      for (Difference& difference : selector) difference.interval = {std::nan(""), std::nan("")};
  table.differences.erase("top");
  const auto json = nlohmann::json::parse(tables_json({{"held_out", table}}));
  CHECK(json.at("differences").at("held_out").at("mean").at("svnet-rand").at("fm").at("low").is_null());
  CHECK_THAT(table_text(table, "x"), !Catch::Contains(" ["));
}

TEST_CASE("a pose without scores gets its top view") {
  const Scene scene;
  std::vector<double> scores(12, std::nan(""));
  scores[2] = 0.5;
  CHECK(best_views(scene.dataset, scores) == std::vector<std::int32_t>{1, 2, 5, 7, 9, 11});
}

TEST_CASE("the columns of tables are explained, each selector once") {
  EvaluationTables tables;
  tables["training"].selectors = {"top", "opt_ind"};
  tables["held_out"].selectors = {"top", "svnet"};
  const std::string text = columns_text(tables);
  CHECK_THAT(text, Catch::Contains("top         the top view\n") &&
                       Catch::Contains("svnet       the view with the best") && Catch::Contains("opt_ind") &&
                       !Catch::Contains("broadside") && Catch::Contains("purity"));
  CHECK(text.find("the top view\n") == text.rfind("the top view\n"));
}

TEST_CASE("the paper's figures stand beside the paper's own split") {
  Config config;
  config.dataset.held_out = {"wrench", "comb", "hammer", "knife", "toothbrush"};
  CHECK(holds_out_papers_categories(config));
  config.dataset.held_out.pop_back();
  CHECK_FALSE(holds_out_papers_categories(config));
  EvaluationTable table;
  table.pipelines = {"xception_ward", "mobilenet_v2_ward"};
  table.selectors = {"rand", "svnet", "broadside"};
  CHECK(paper_figures_text(table, Split::held_out) ==
        "The paper, on its own images (FM / NMI / purity):\n"
        "  xception_ward:  rand .48 / .56 / .74  svnet .55 / .63 / .78\n");
  table.pipelines = {"mobilenet_v2_ward"};
  CHECK(paper_figures_text(table, Split::held_out).empty());
}
