// From scores of pairs of views to a model that ranks the next view.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "bar_dataset.h"
#include "base/error.h"
#include "base/parallel.h"
#include "io/images/image_file.h"
#include "io/models/model_file.h"
#include "io/views/dataset_folder.h"
#include "predict/predictor.h"
#include "small_run.h"
#include "temporary_folder.h"
#include "train/next_head.h"
#include "train/stages/cross_validation.h"
#include "train/stages/model.h"
#include "train/stages/pair_scores.h"
#include "train/stages/plan.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"

using namespace svnet;
using namespace svnet::train;

namespace {

struct Bars {
  Bars() {
    write_bar_dataset(folder.path() / "data");
    config = small_config(folder.path() / "data");
    config.dataset.held_out = {"awl", "rod"};
    config.sv_net.frame = frame::FrameChoice::axis;
    config.sv_net.next_view = NextViewChoice::ridge;
    config.scores.problems = 2000;
    config.evaluation.views = 3;
    config.evaluation.selectors = {"top", "svnet", "next", "top_svnet", "top_next"};
    config.evaluation.pipelines = {"tiny_xception_ward"};
  }
  Run run(const std::string& name, const Messages& messages = {}) const {
    return make_run(config, io::read_view_dataset(config.dataset.root), folder.path() / name, messages);
  }

  TemporaryFolder folder;
  Config config;
};

Model model_of(const Run& run) {
  FeaturesStage features(run);
  return model_stage(run, features, scores_stage(run, features));
}

std::vector<float> weights(const Model& model) {
  const auto values = model.next_parameters.at("ridge/kernel").values<float>();
  return {values.begin(), values.end()};
}

}  // namespace

TEST_CASE("pairs are those of the views of each training pose, at most 300 of a pose") {
  ViewDataset dataset;
  dataset.categories = {"a", "b"};
  for (Index pose = 0; pose < 2; ++pose) {
    const Index views = pose == 0 ? 4 : 40;
    dataset.poses.push_back({});
    dataset.poses.back().category = pose;
    dataset.poses.back().first_view = static_cast<Index>(dataset.views.size());
    dataset.poses.back().view_count = views;
    for (Index v = 0; v < views; ++v) dataset.views.push_back({});
  }
  CHECK(pairs_of_views(dataset, {true, false}, 3).views ==
        std::vector<std::int32_t>{0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3});
  const semantics::ViewSets drawn = pairs_of_views(dataset, {false, true}, 3);
  CHECK(drawn.count() == kMostPairsPerPose);
  std::set<std::pair<std::int32_t, std::int32_t>> distinct;
  for (Index i = 0; i < drawn.count(); ++i) {
    const auto pair = drawn.set(i);
    CHECK((pair[0] >= 4 && pair[0] < pair[1] && pair[1] < 44));
    distinct.insert({pair[0], pair[1]});
  }
  CHECK(static_cast<Index>(distinct.size()) == kMostPairsPerPose);
  CHECK(pairs_of_views(dataset, {false, true}, 3).views == drawn.views);
  CHECK(pairs_of_views(dataset, {false, true}, 4).views != drawn.views);
}

TEST_CASE("the next view is learned from pairs, the same for any number of threads, and its stages are reused") {
  const Bars bars;
  const int threads_before = Parallel::shared().threads();
  std::vector<std::vector<float>> learned;
  for (const int threads : {1, 3}) {
    Parallel::shared().resize(threads);
    learned.push_back(weights(model_of(bars.run("run" + std::to_string(threads)))));
  }
  Parallel::shared().resize(threads_before);
  CHECK(learned[0] == learned[1]);

  const std::filesystem::path folder = bars.folder.path() / "run1";
  const Scores pairs = io::read_scores(folder / "pair-scores.h5");
  CHECK(pairs.paths.size() == 4 * 2 * 21);
  CHECK(pairs.paths[0].find(" + ") != std::string::npos);
  Log log;
  std::filesystem::remove(folder / "model.safetensors");
  const Run again = bars.run("run1", log.messages);
  FeaturesStage planned(again);
  const auto stages = planned_stages(again, planned);
  REQUIRE(stages.size() == 4);
  CHECK(stages[2].stage == "scores of pairs");
  CHECK(stages[2].work == "168 pairs, 2000 problems");
  CHECK(stages[2].seconds > 0.0);
  const Model model = model_of(again);
  CHECK(weights(model) == learned[0]);
  CHECK(log.has("scores of pairs: reused pair-scores.h5"));
  CHECK(log.has("shapes of views: reused view-shapes.h5"));

  // The file predicts what the run predicts.
  FeaturesStage features(again);
  const NextScores next = next_scores(again, features, model);
  const std::vector<std::int32_t> tops = top_views(again.dataset);
  const std::vector<double> scores = next(tops, 1);
  REQUIRE(scores.size() == again.dataset.views.size());
  const predict::Predictor predictor(folder / "model.safetensors");
  for (std::size_t pose = 0; pose < again.dataset.poses.size(); ++pose) {
    const View& top = again.dataset.views[static_cast<std::size_t>(tops[pose])];
    const Image image = io::read_image(again.dataset.root / top.path);
    const frame::TakenView taken{{90, 90}, frame::view_shape(image)};
    std::vector<view::CameraPose> poses;
    for (const View& view : again.dataset.views_of(static_cast<Index>(pose)))
      poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    const auto outside = predictor.next_scores(predictor.embed(image), std::span(&taken, 1), poses);
    const auto first = static_cast<std::size_t>(again.dataset.poses[pose].first_view);
    for (std::size_t i = 0; i < outside.size(); ++i)
      CHECK(static_cast<double>(outside[i]) == Approx(scores[first + i]).margin(1e-6));
  }
}

TEST_CASE("selectors of the next view take other views than those taken") {
  const Bars bars;
  const Run run = bars.run("run");
  FeaturesStage features(run);
  const Scores scores = scores_stage(run, features);
  const Model model = model_stage(run, features, scores);
  const std::vector<double> predicted = predicted_scores(run, features, model);
  const NextScores next = next_scores(run, features, model);
  const auto tops = top_views(run.dataset);
  for (const auto& views : {views_after(run.dataset, tops, next, 3), views_beside(run.dataset, tops, predicted, 3)}) {
    REQUIRE(views.size() == 3 * tops.size());
    for (std::size_t pose = 0; pose < tops.size(); ++pose) {
      CHECK(views[3 * pose] == tops[pose]);
      CHECK(std::set<std::int32_t>(views.begin() + static_cast<std::ptrdiff_t>(3 * pose),
                                   views.begin() + static_cast<std::ptrdiff_t>(3 * pose + 3))
                .size() == 3);
    }
  }
  CHECK_THROWS_WITH(views_after(run.dataset, tops, {}, 2), Catch::Contains("train it with sv_net.next_view: ridge"));

  const SelectorInputs inputs{.dataset = run.dataset,
                              .scores = [] { return ViewScores{}; },
                              .predicted = predicted,
                              .training_scores = scores,
                              .frames = {},
                              .next = next};
  std::vector<std::string> names;
  for (const Selector& selector :
       chosen_by(selectors_of_table({"svnet", "next", "top_next"}, Split::held_out), inputs, 2))
    names.push_back(selector.name);
  CHECK(names == std::vector<std::string>{"svnet", "svnet_2", "next_2", "top_next_2"});
  Bars single;
  single.config.evaluation.views = 1;
  CHECK_THROWS_WITH(single.run("one"), Catch::Contains("next chooses 2 views or more; set evaluation.views"));
}

TEST_CASE("several backbones share the pairs, and rounds learn the next view once", "[slow]") {
  Bars bars;
  bars.config.dataset.held_out = {};
  bars.config.scores.backbones = {"tiny_xception", "mobilenet_v2"};
  bars.config.scores.rounds = 1;
  bars.config.scores.problems = 300;
  Log log;
  const Run run = bars.run("run", log.messages);
  FeaturesStage features(run);
  const CrossValidation validation = cross_validate(run, features, {{"awl", "bar"}, {"cue", "fid"}, {"peg", "rod"}});
  const auto& names = validation.table.selectors;
  CHECK(std::ranges::count(names, "next_2") == 1);
  CHECK(std::ranges::count(names, "top_next_3") == 1);
  const auto fold = run.folder / "fold-1";
  for (const char* file : {"pair-scores.h5", "pair-scores-tiny_xception.h5", "pair-scores-mobilenet_v2.h5"})
    CHECK(std::filesystem::exists(fold / file));
  CHECK_FALSE(std::filesystem::exists(fold / "round-1" / "pair-scores.h5"));
  CHECK(std::ranges::count_if(log.lines, [](const std::string& line) { return line.starts_with("next view: "); }) == 3);
}
