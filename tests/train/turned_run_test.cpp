#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bar_dataset.h"
#include "base/error.h"
#include "base/parallel.h"
#include "frame/turns.h"
#include "io/images/image_file.h"
#include "io/models/model_file.h"
#include "io/views/dataset_folder.h"
#include "predict/predictor.h"
#include "small_run.h"
#include "temporary_folder.h"
#include "train/stages/cross_validation.h"
#include "train/stages/model.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"
#include "train/stages/top_features.h"
#include "train/turned_features.h"
#include "train/turned_projection.h"

using namespace svnet;
using namespace svnet::train;
using frame::FrameChoice;

namespace {

namespace fs = std::filesystem;

/// The bars, and runs of SV-net with turns on them: tiny_xception, 6 x 6 places.
struct Bars {
  Bars() {
    write_bar_dataset(folder.path() / "data", true);
    config = small_config(folder.path() / "data");
    config.dataset.held_out = {"rod"};
    config.sv_net.layer = "block4_act";
    config.sv_net.frame = FrameChoice::turned;
    config.evaluation.problems = 100;
    config.evaluation.pipelines = {"tiny_xception_ward"};
  }
  Run run(const Config& wanted, const std::string& name, const Messages& messages = {}) const {
    return make_run(wanted, io::read_view_dataset(wanted.dataset.root), folder.path() / name, messages);
  }

  TemporaryFolder folder;
  Config config;
};

}  // namespace

TEST_CASE("a model with turns is trained, written, and predicts outside of the run what it predicts in it", "[slow]") {
  const FrameChoice choice = GENERATE(FrameChoice::turned, FrameChoice::turned_axis);
  const auto depth = choice == FrameChoice::turned ? frame::DepthChoice::none : frame::DepthChoice::heights;
  Bars bars;
  bars.config.sv_net.frame = choice;
  bars.config.sv_net.depth = depth;
  const Run run = bars.run(bars.config, "run");
  FeaturesStage features(run);
  const Scores scores = scores_stage(run, features);
  const Model made = model_stage(run, features, scores);
  CHECK(made.frame == choice);
  CHECK(made.backbone_output == "projection");
  const Model model = trained_model(run, features);
  const std::vector<float> tops = top_features(run, features, model);
  const std::vector<double> predicted = predicted_scores(run, features, model);
  REQUIRE(predicted.size() == run.dataset.views.size());

  const predict::Predictor predictor(run.folder / "model.safetensors");
  const auto size = static_cast<std::size_t>(predictor.feature_count());
  for (std::size_t pose = 0; pose < run.dataset.poses.size(); ++pose) {
    const View& top = run.dataset.views[static_cast<std::size_t>(run.dataset.top_view(static_cast<Index>(pose)))];
    const DepthImage measured = frame::depth_of(frame::ellipse(1, 1, 0), [](double, double) { return 0.03; });
    const Tensor embedded = predictor.embed(io::read_image(run.dataset.root / top.path), &measured);
    std::vector<view::CameraPose> poses;
    for (const View& view : run.dataset.views_of(static_cast<Index>(pose)))
      poses.push_back({static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)});
    // The made-up depth is not the dataset's: what depends on it is taken from the run.
    Tensor seen = embedded;
    const std::size_t turns = size - (choice == FrameChoice::turned ? 0 : 15);
    for (std::size_t i = size - turns; i < size; ++i)
      CHECK(embedded.data<float>()[i] == Approx(tops[pose * size + i]).margin(1e-4));
    std::copy_n(tops.begin() + static_cast<std::ptrdiff_t>(pose * size), size - turns, seen.data<float>());
    const auto outside = predictor.scores(seen, poses);
    const auto first = static_cast<std::size_t>(run.dataset.poses[pose].first_view);
    for (std::size_t i = 0; i < outside.size(); ++i) CHECK(outside[i] == Approx(predicted[first + i]).margin(1e-5));
  }
}

TEST_CASE("features of turns are made once, and the fingerprint of the model covers them") {
  const Bars bars;
  Log first;
  const Run run = bars.run(bars.config, "run", first.messages);
  FeaturesStage features(run);
  const Features& turned = features.turned_features("tiny_xception", "block4_act");
  CHECK(turned.count == 12 * frame::kTurns);
  CHECK(turned.dimension == 9 * 160);
  CHECK(fs::exists(run.folder / "features-tiny_xception-block4_act-turned.h5"));
  check_turned_rows(run.dataset, turned);
  CHECK(turned.theta_phi_deg[17] == std::array<double, 2>{33.75, 90});
  CHECK(turned.input_fingerprint != features.fingerprint("tiny_xception", "block4_act"));
  CHECK(features.turned_fingerprint("tiny_xception", "block4_act") != turned.input_fingerprint);

  Log second;
  const Run again = bars.run(bars.config, "run", second.messages);
  FeaturesStage reused(again);
  CHECK(reused.turned_features("tiny_xception", "block4_act").values == turned.values);
  CHECK(second.has("turned features of tiny_xception: reused"));
  Features wrong = turned;
  std::swap(wrong.paths.front(), wrong.paths.back());
  CHECK_THROWS_WITH(check_turned_rows(run.dataset, wrong), Catch::StartsWith("turned features: row 0 is rod"));
  wrong.paths.pop_back();
  CHECK_THROWS_AS(check_turned_rows(run.dataset, wrong), Error);

  // Components are those of the training categories.
  const auto with = features.turned_components("tiny_xception", "block4_act", run.training_categories()).directions;
  CHECK(features.turned_components("tiny_xception", "block4_act", run.held_out).directions != with);
  CHECK(features.turned_components("tiny_xception", "block4_act", run.training_categories()).directions == with);
}

TEST_CASE("cross-validation with turns beats chance on other categories, with the same bits for any number of threads",
          "[slow]") {
  Bars bars;
  bars.config.dataset.held_out = {};
  bars.config.scores.problems = 600;
  bars.config.scores.rounds = 1;
  bars.config.sv_net.frame = FrameChoice::turned_axis;
  const std::vector<Fold> folds{{"awl", "bar"}, {"cue", "fid"}, {"peg", "rod"}};
  const int threads_before = Parallel::shared().threads();
  std::vector<std::vector<float>> weights;
  for (const int threads : {1, 2}) {
    Parallel::shared().resize(threads);
    Log log;
    const Run run = bars.run(bars.config, "run" + std::to_string(threads), log.messages);
    FeaturesStage features(run);
    const CrossValidation result = cross_validate(run, features, folds);
    CHECK(result.within_pose.spearman > 0.2);
    // Folds and rounds share the features of the turns.
    CHECK_FALSE(log.has("reused features"));
    CHECK_FALSE(fs::exists(run.folder / "fold-1/features-tiny_xception-block4_act-turned.h5"));
    CHECK(fs::exists(run.folder / "fold-1/round-1/model.safetensors"));
    const Model model = io::read_model(run.folder / "fold-3/model.safetensors");
    const auto kernel = model.head_parameters.at("ridge/kernel").values<float>(),
               projection = model.backbone_parameters.at("projection/kernel").values<float>();
    weights.emplace_back(kernel.begin(), kernel.end());
    weights.back().insert(weights.back().end(), projection.begin(), projection.end());
  }
  Parallel::shared().resize(threads_before);
  CHECK(weights[0] == weights[1]);
}

TEST_CASE("an unknown layer is refused before any work, in frames with turns too") {
  Bars bars;
  bars.config.sv_net.layer = "block4_at";
  CHECK_THROWS_WITH(bars.run(bars.config, "run"), Catch::Contains("block4_at") && Catch::Contains("'block4_act'"));
}
