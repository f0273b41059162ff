#include "train/stages/cross_validation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "bar_dataset.h"
#include "base/error.h"
#include "base/parallel.h"
#include "io/models/model_file.h"
#include "io/views/dataset_folder.h"
#include "io/views/scores_file.h"
#include "small_run.h"
#include "temporary_folder.h"
#include "train/frame_head.h"
#include "train/stages/cross_validation_text.h"
#include "train/stages/predictions.h"
#include "train/stages/top_features.h"

using namespace svnet;
using namespace svnet::train;

namespace {

namespace fs = std::filesystem;

ViewDataset named(const std::vector<std::string>& categories) {
  ViewDataset dataset;
  dataset.categories = categories;
  return dataset;
}

Config bar_config(const fs::path& data) {
  Config config = small_config(data);
  config.dataset.held_out = {};
  config.scores.problems = 600;
  config.scores.max_categories = 4;  // of six, so that problems tell categories apart
  config.sv_net.frame = frame::FrameChoice::axis;
  config.evaluation.problems = 200;
  config.evaluation.pipelines = {"tiny_xception_ward", "tiny_xception_kmeans"};
  return config;
}

/// The bars, and cross-validation of configurations on them.
struct Bars {
  Bars() { write_bar_dataset(folder.path() / "data", true); }

  Run run(const Config& wanted, const std::string& name, const Messages& messages = {}) const {
    return make_run(wanted, io::read_view_dataset(wanted.dataset.root), folder.path() / name, messages);
  }
  CrossValidation validate(const Run& run, const std::vector<Fold>& folds) const {
    FeaturesStage features(run);
    return cross_validate(run, features, folds);
  }

  TemporaryFolder folder;
  Config config = bar_config(folder.path() / "data");
};

const std::vector<Fold> kFolds{{"awl", "bar"}, {"cue", "fid"}, {"peg", "rod"}};

double fm(const EvaluationTable& table, const std::string& selector, std::size_t pipeline = 0) {
  const auto at = std::find(table.selectors.begin(), table.selectors.end(), selector);
  return table.cells[pipeline][static_cast<std::size_t>(at - table.selectors.begin())][0].mean;
}

}  // namespace

TEST_CASE("drawn folds have each category once and about equal sizes, by the seed") {
  const ViewDataset dataset = named({"a", "b", "c", "d", "e", "f", "g", "h"});
  const std::vector<Fold> folds = drawn_folds(dataset, 3, 7);
  REQUIRE(folds.size() == 3);
  std::multiset<std::string> all;
  for (const Fold& fold : folds) {
    CHECK((fold.size() == 2 || fold.size() == 3));
    all.insert(fold.begin(), fold.end());
  }
  CHECK(all == std::multiset<std::string>(dataset.categories.begin(), dataset.categories.end()));
  CHECK(drawn_folds(dataset, 3, 7) == folds);
  CHECK(drawn_folds(dataset, 3, 8) != folds);
  CHECK(drawn_folds(dataset, 8, 7).back().size() == 1);
}

TEST_CASE("folds that leave too little to train on are refused") {
  const ViewDataset dataset = named({"a", "b", "c"});
  CHECK(drawn_folds(dataset, 3, 1).size() == 3);
  for (const Index count : {Index{1}, Index{2}, Index{4}}) {
    INFO(count);
    CHECK_THROWS_WITH(drawn_folds(dataset, count, 1),
                      Catch::Contains("3 categories cannot be split into " + std::to_string(count) +
                                      " folds that leave 2 categories or more to train on"));
  }
  CHECK_THROWS_WITH(completed_folds(dataset, {{"a", "b"}}), "--fold: 2 categories of 3 leave fewer than 2 to train on");
}

TEST_CASE("categories that no given fold names are one more fold") {
  const ViewDataset dataset = named({"a", "b", "c", "d", "e"});
  CHECK(completed_folds(dataset, {{"b"}, {"d", "a"}}) == std::vector<Fold>{{"b"}, {"d", "a"}, {"c", "e"}});
  CHECK(completed_folds(dataset, {{"a", "b"}, {"c"}, {"d", "e"}}).size() == 3);
}

TEST_CASE("a fold of an unknown category, or of one twice, is refused") {
  const ViewDataset dataset = named({"apple", "ball", "car", "dog", "egg"});
  CHECK_THROWS_WITH(completed_folds(dataset, {{"aple"}}),
                    Catch::StartsWith("--fold") && Catch::Contains("'aple'") && Catch::Contains("'apple'"));
  CHECK_THROWS_WITH(completed_folds(dataset, {{"car"}, {"ball", "car"}}), "--fold: the category 'car' is named twice");
  CHECK_THROWS_WITH(completed_folds(dataset, {{"car", "car"}}), "--fold: the category 'car' is named twice");
}

TEST_CASE("every choice of some categories is a fold") {
  const ViewDataset dataset = named({"a", "b", "c", "d", "e"});
  const std::vector<Fold> folds = each_choice_of(dataset, 2);
  CHECK(folds.size() == 10);
  CHECK(folds.front() == Fold{"a", "b"});
  CHECK(folds[4] == Fold{"b", "c"});
  CHECK(folds.back() == Fold{"d", "e"});
  CHECK(std::set<Fold>(folds.begin(), folds.end()).size() == 10);
  CHECK(each_choice_of(dataset, 3).size() == 10);
  for (const Index size : {Index{1}, Index{4}})
    CHECK_THROWS_WITH(each_choice_of(dataset, size),
                      Catch::Contains("it must be at least 2, and leave at least 2 to train on"));
  std::vector<std::string> many;
  for (int i = 0; i < 30; ++i) many.push_back("category " + std::to_string(i));
  CHECK_THROWS_WITH(each_choice_of(named(many), 5),
                    "--each-choice-of: there are more than 2000 choices of 5 of 30 categories");
}

TEST_CASE("a fold can be judged by problems of its own categories") {
  const Bars bars;
  const Run run = bars.run(bars.config, "run");
  FeaturesStage features(run);
  const auto folds = each_choice_of(run.dataset, 3);
  const CrossValidation result = cross_validate(run, features, folds, FoldProblems::own_categories);
  REQUIRE(result.folds.size() == 20);
  CHECK(result.within_pose.poses == 20 * 6);
  for (const double predicted : result.predicted) CHECK(std::isfinite(predicted));
  CHECK(result.table.problems == 200);
  // Problems of few categories are easier than those of all six.
  CHECK(fm(result.table, "rand") > fm(cross_validate(run, features, kFolds).table, "rand"));
  CHECK(fm(result.table, "svnet") > fm(result.table, "rand"));
  const Difference& ahead = result.table.differences.at("rand")[0][4][0];
  CHECK(std::isfinite(ahead.interval.low));
}

TEST_CASE("every category is chosen by a model that never saw it, and the choices beat chance") {
  const Bars bars;
  const Run run = bars.run(bars.config, "run");
  FeaturesStage features(run);
  const CrossValidation result = cross_validate(run, features, kFolds);
  REQUIRE(result.folds.size() == 3);
  CHECK(result.within_pose.poses == 12);
  REQUIRE(result.predicted.size() == run.dataset.views.size());
  CHECK(best_views(run.dataset, result.predicted) == result.choices[4].view);
  const Scores all = io::read_scores(run.folder / "scores.h5");
  std::vector<double> chosen_by(run.dataset.views.size(), std::nan(""));
  for (std::size_t f = 0; f < kFolds.size(); ++f) {
    INFO("fold " << f + 1);
    CHECK(result.folds[f].held_out == kFolds[f]);
    const fs::path folder = run.folder / ("fold-" + std::to_string(f + 1));
    const Scores scores = io::read_scores(folder / "scores.h5");
    const Model model = io::read_model(folder / "model.safetensors");
    const std::vector<double> predicted = predicted_scores(run, features, model);
    std::vector<bool> held_out;
    for (const std::string& category : run.dataset.categories)
      held_out.push_back(std::find(kFolds[f].begin(), kFolds[f].end(), category) != kFolds[f].end());
    std::vector<bool> training = held_out;
    training.flip();
    const Model expected = model_of(fit_frame_head(run.dataset, top_features(run, features, model), scores, training,
                                                   Target::individual, frame_spec(model), run.seed()));
    const auto weights = model.head_parameters.at("ridge/kernel").values<float>(),
               from_others = expected.head_parameters.at("ridge/kernel").values<float>();
    CHECK(std::equal(weights.begin(), weights.end(), from_others.begin(), from_others.end()));
    for (std::size_t v = 0; v < scores.individual.size(); ++v) {
      const bool unseen = held_out[static_cast<std::size_t>(run.dataset.views[v].category)];
      CHECK(std::isnan(scores.individual[v]) == unseen);
      if (unseen) chosen_by[v] = predicted[v];
    }
    const WithinPose within = within_pose(run.dataset, predicted, all.individual, held_out);
    CHECK(result.folds[f].within_pose.poses == 4);
    CHECK(result.folds[f].within_pose.spearman == Approx(within.spearman));
    CHECK(result.folds[f].within_pose.regret == Approx(within.regret));
  }
  CHECK(std::none_of(chosen_by.begin(), chosen_by.end(), [](double score) { return std::isnan(score); }));
  const WithinPose within = within_pose(run.dataset, chosen_by, all.individual, std::vector<bool>(6, true));
  CHECK(result.within_pose.spearman == Approx(within.spearman));
  CHECK(result.within_pose.better_than_rand == Approx(within.better_than_rand));

  CHECK(result.table.problems == 200);
  CHECK(result.table.selectors ==
        std::vector<std::string>{"top", "rand", "broadside", "phi_map", "svnet", "opt_glob", "opt_ind"});
  CHECK(result.within_pose.spearman > 0.3);
  CHECK(fm(result.table, "svnet") > fm(result.table, "rand") + 0.03);
  CHECK(fm(result.table, "opt_ind") > fm(result.table, "rand") + 0.05);
}

TEST_CASE("cross-validation has the same bits for any number of threads, and reuses what fits") {
  const Bars bars;
  const int threads_before = Parallel::shared().threads();
  std::vector<std::string> texts;
  for (const int threads : {1, 3}) {
    Parallel::shared().resize(threads);
    Log log;
    const Run run = bars.run(bars.config, "run" + std::to_string(threads), log.messages);
    texts.push_back(cross_validation_json({{"", bars.validate(run, kFolds)}}));
    CHECK_FALSE(log.has("reused"));
  }
  Parallel::shared().resize(threads_before);
  CHECK(texts[0] == texts[1]);
  Log log;
  const Run run = bars.run(bars.config, "run1", log.messages);
  CHECK(cross_validation_json({{"", bars.validate(run, kFolds)}}) == texts[0]);
  CHECK(std::count_if(log.lines.begin(), log.lines.end(), [](const std::string& line) {
          return line.starts_with("scores: reused") || line.starts_with("SV-net: reused");
        }) == 4 + 3);
}

TEST_CASE("cross-validation with depth and with on-policy rounds") {
  const Bars bars;
  Config config = bars.config;
  config.sv_net.depth = frame::DepthChoice::heights;
  config.scores.rounds = 1;
  config.scores.problems = 300;
  config.evaluation.selectors = {"rand", "svnet"};
  const Run run = bars.run(config, "run");
  const CrossValidation result = bars.validate(run, kFolds);
  CHECK(result.table.selectors == config.evaluation.selectors);
  CHECK(result.table.differences.count("top") == 0);
  CHECK(fs::exists(run.folder / "fold-2/scores-round-1.h5"));
  // The true scores of views depend on no model.
  CHECK_FALSE(fs::exists(run.folder / "scores-round-1.h5"));
  CHECK(io::read_model(run.folder / "fold-3/model.safetensors").depth == frame::DepthChoice::heights);
}

TEST_CASE("a configuration that holds categories out is refused") {
  const Bars bars;
  Config config = bars.config;
  config.dataset.held_out = {"rod"};
  CHECK_THROWS_WITH(bars.validate(bars.run(config, "run"), kFolds),
                    "[folds] the configuration holds categories out of every fold");
}

TEST_CASE("crossval.json has tables, differences with intervals, folds and what was tried") {
  const Bars bars;
  const Run run = bars.run(bars.config, "run");
  const CrossValidation result = bars.validate(run, kFolds);
  const auto json = nlohmann::json::parse(cross_validation_json({{"", result}}));
  CHECK(json.at("format") == 1);
  CHECK(json.at("problems") == 200);
  for (const std::string pipeline : {"tiny_xception_ward", "tiny_xception_kmeans"})
    for (const std::string selector : {"top", "rand", "broadside", "phi_map", "svnet", "opt_glob", "opt_ind"})
      for (const std::string metric : {"fm", "nmi", "purity"}) {
        INFO(pipeline << " " << selector << " " << metric);
        const auto& cell = json.at("pipelines").at(pipeline).at(selector).at(metric);
        CHECK(cell.at("low") <= cell.at("mean"));
        CHECK(cell.at("mean") <= cell.at("high"));
      }
  CHECK(json.at("pipelines").at("tiny_xception_ward").at("svnet").at("fm").at("mean").get<double>() ==
        Approx(fm(result.table, "svnet")));
  for (const std::string row : {"tiny_xception_ward", "tiny_xception_kmeans", "mean"})
    for (const std::string other : {"svnet-rand", "svnet-top", "svnet-broadside", "svnet-phi_map"})
      for (const std::string key : {"mean", "low", "high"})
        CHECK(json.at("differences").at(row).at(other).at("fm").at(key).is_number());
  CHECK(json.at("within_pose").at("poses") == 12);
  REQUIRE(json.at("folds").size() == 3);
  CHECK(json.at("folds")[1].at("held_out") == std::vector<std::string>{"cue", "fid"});
  CHECK(json.at("folds")[1].at("within_pose").at("poses") == 4);
  CHECK_FALSE(json.contains("tried"));

  const auto both =
      nlohmann::json::parse(cross_validation_json({{"scores.rounds=0", result}, {"scores.rounds=2", result}}));
  CHECK(both.at("pipelines") == json.at("pipelines"));
  REQUIRE(both.at("tried").size() == 2);
  CHECK(both.at("tried")[1].at("settings") == "scores.rounds=2");
  CHECK(both.at("tried")[1].at("within_pose") == json.at("within_pose"));
  CHECK(both.at("tried")[1].at("differences") == json.at("differences"));

  const std::string text = cross_validation_text({"scores.rounds=2", result});
  for (const char* part : {"Cross-validation over categories, scores.rounds=2", "SV-net minus another selector",
                           "- broadside", "Within poses: Spearman", "cue, fid: Spearman", "of 4 poses"})
    CHECK_THAT(text, Catch::Contains(part));
}
