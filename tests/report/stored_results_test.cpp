// Files of run folders that are missing or damaged are named, with what to do.
#include "report/stored_results.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "temporary_folder.h"

using namespace svnet;
using namespace svnet::report;
using Catch::Contains;

namespace {

template <class Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const char* const kEvaluation = R"({"format": 1, "problems": 40, "tables": {
 "training": {"p": {"top": {"fm": {"mean": 0.5, "standard_error": 0.01}, "nmi": {"mean": 0.5}, "purity": {"mean": 0.5}}}},
 "held_out": {"p": {"svnet": {"fm": {"mean": 0.7, "standard_error": 0.02, "low": 0.6, "high": 0.8},
   "nmi": {"mean": 0.5}, "purity": {"mean": 0.5}}}}},
 "differences": {"held_out": {"p": {"svnet-top": {"fm": {"mean": 0.1, "low": null, "high": null},
   "nmi": {"mean": 0.1, "low": 0.05, "high": 0.2}, "purity": {"mean": 0.1, "low": -0.05, "high": 0.2}}}}}})";

ViewDataset two_views() {
  ViewDataset dataset;
  dataset.root = "photos";
  dataset.views.resize(2);
  dataset.views[0].path = "mug/1/1/45_0.png";
  dataset.views[1].path = "mug/1/1/90_90.png";
  return dataset;
}

}  // namespace

TEST_CASE("tables are read with intervals and leads, that of held-out categories first") {
  const TemporaryFolder folder;
  folder.write("evaluation.json", kEvaluation);
  const std::vector<Table> tables = read_tables(folder.path());
  REQUIRE(tables.size() == 2);
  CHECK(tables[0].held_out);
  CHECK(tables[0].cells[0][0][0].low == 0.6);
  CHECK(tables[0].largest_standard_error == 0.02);
  CHECK(tables[0].problems == 40);
  REQUIRE(tables[0].leads.size() == 1);
  CHECK(tables[0].leads[0].over == "top");
  CHECK_FALSE(tables[0].leads[0].rows[0][0].has_interval());
  CHECK(tables[0].leads[0].rows[0][1].is_sure());
  CHECK_FALSE(tables[0].leads[0].rows[0][2].is_sure());
  CHECK_FALSE(tables[1].cells[0][0][0].has_interval());
}

TEST_CASE("a missing, damaged or strange evaluation.json is an error that names it") {
  const TemporaryFolder folder;
  const auto error = [&] { return error_of([&] { static_cast<void>(read_tables(folder.path())); }); };
  CHECK_THAT(error(), Contains("evaluation.json: no such file; run svnet-eval, or svnet-crossval, on this run again"));
  folder.write("evaluation.json", std::string(kEvaluation).substr(0, 100));
  CHECK_THAT(error(), Contains("evaluation.json: is damaged, it holds no JSON object"));
  folder.write("evaluation.json", R"({"format": 2})");
  CHECK_THAT(error(), Contains("evaluation.json: its format is not 1"));
  folder.write("evaluation.json", R"({"format": 1, "problems": 40, "tables": {"training": {"p": {"top": {}}}}})");
  CHECK_THAT(error(), Contains("evaluation.json: is damaged: ") && Contains("fm"));
  folder.write("evaluation.json", R"({"format": 1, "problems": "many", "tables": {"training": {}}})");
  CHECK_THAT(error(), Contains("evaluation.json: is damaged: "));
}

TEST_CASE("predictions come back as they were written, and belong to one dataset") {
  const TemporaryFolder folder;
  const ViewDataset dataset = two_views();
  write_predictions(folder.path(), dataset,
                    {{.predicted = 0.25, .score = std::nan(""), .standard_error = std::nan(""), .held_out = true},
                     {.predicted = 1.0 / 3, .score = 0.5, .standard_error = 0.01, .held_out = false}});
  const auto predictions = read_predictions(folder.path(), dataset);
  REQUIRE(predictions.size() == 2);
  CHECK(predictions[0].held_out);
  CHECK(std::isnan(predictions[0].score));
  CHECK(predictions[1].predicted == 1.0 / 3);

  ViewDataset other = dataset;
  other.views[1].path = "mug/1/1/60_90.png";
  CHECK_THAT(error_of([&] { static_cast<void>(read_predictions(folder.path(), other)); }),
             Contains("predictions.json: view 1 is mug/1/1/90_90.png, that of the dataset is mug/1/1/60_90.png"));
  other.views.resize(1);
  CHECK_THAT(error_of([&] { static_cast<void>(read_predictions(folder.path(), other)); }),
             Contains("is about 2 views, the dataset photos has 1"));
}

TEST_CASE("curves are optional, and their damage is an error") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_curves(folder.path()));
  folder.write("metrics.csv", "epoch,step,learning_rate,loss,validation_loss\n1,10,0.1,0.5,\n2,20,0.1,0.25,0.75\n");
  const auto curves = read_curves(folder.path());
  REQUIRE(curves);
  CHECK(curves->loss == std::vector<double>{0.5, 0.25});
  CHECK(std::isnan(curves->validation_loss[0]));
  CHECK(curves->validation_loss[1] == 0.75);
  CHECK(std::isnan(curves->validation_spearman[1]));
  folder.write("metrics.csv", "epoch,loss\n1,much\n");
  CHECK_THAT(error_of([&] { static_cast<void>(read_curves(folder.path())); }),
             Contains("metrics.csv, line 2: 'much' is not a number"));
}

TEST_CASE("folds are read from crossval.json") {
  const TemporaryFolder folder;
  folder.write("crossval.json", R"({"format": 1, "folds": [{"held_out": ["mug", "pen"], "within_pose": {"poses": 2,
    "spearman": 0.5, "regret": 0.1, "better_than_top": 1, "better_than_rand": null}}]})");
  const auto folds = read_folds(folder.path());
  REQUIRE(folds.size() == 1);
  CHECK(folds[0].held_out == std::vector<std::string>{"mug", "pen"});
  CHECK(folds[0].within_pose.spearman == 0.5);
  CHECK(std::isnan(folds[0].within_pose.better_than_rand));
}
