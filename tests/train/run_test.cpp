#include "train/run.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/parallel.h"
#include "io/files/file_hash.h"
#include "io/files/snapshot_path.h"
#include "io/models/backbone_file.h"
#include "io/views/dataset_folder.h"
#include "models/backbone.h"
#include "predict/predictor.h"
#include "small_dataset.h"
#include "small_run.h"
#include "train/calibration.h"
#include "train/stages/contact_sheet.h"
#include "train/stages/dry_run.h"
#include "train/stages/evaluation.h"
#include "train/stages/made_scores.h"
#include "train/stages/model.h"
#include "train/stages/predictions.h"
#include "train/stages/scores.h"
#include "train/view_inputs.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::models;
using namespace svnet::predict;
using namespace svnet::train;
using namespace svnet::view;

namespace {

/// A run and its stages, each with what it needs from the earlier ones.
class Stages {
 public:
  Stages(const Config& config, const ViewDataset& dataset, const std::filesystem::path& folder,
         const Messages& messages)
      : run_(make_run(config, dataset, folder, messages)), features_(run_) {}

  const Features& features(const std::string& backbone, const std::string& layer) {
    return features_.features(backbone, layer);
  }
  const Scores& scores() {
    if (!scores_) scores_ = scores_stage(run_, features_);
    return *scores_;
  }
  Model model() {
    write_config(run_);
    return model_stage(run_, features_, scores());
  }
  std::vector<double> predicted_scores(const Model& model) {
    return svnet::train::predicted_scores(run_, features_, model);
  }
  EvaluationTables evaluation(std::uint64_t problems) {
    const std::vector<double> predicted = predicted_scores(trained_model(run_, features_));
    return evaluation_stage(run_, {features_, scores(), predicted}, problems);
  }
  std::optional<std::filesystem::path> contact_sheet(std::uint64_t problems) {
    const std::vector<double> predicted = predicted_scores(trained_model(run_, features_));
    return contact_sheet_stage(run_, {features_, scores(), predicted}, problems);
  }

 private:
  Run run_;
  FeaturesStage features_;
  std::optional<Scores> scores_{};
};

/// Trains and evaluates in `folder` and returns the hashes of all results.
std::vector<std::string> results(const Config& config, const std::filesystem::path& folder, const Messages& messages) {
  Stages run(config, read_view_dataset(config.dataset.root), folder, messages);
  run.model();
  run.evaluation(40);
  std::vector<std::string> hashes;
  for (const char* name : {"features-tiny_xception.h5", "scores.h5", "checkpoint-last.safetensors",
                           "checkpoint-best.safetensors", "metrics.csv", "model.safetensors", "evaluation.json"})
    hashes.push_back(file_sha256(folder / name));
  return hashes;
}

}  // namespace

TEST_CASE("a run gives the same bits for any number of threads, and its stages are reused") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  const int threads_before = Parallel::shared().threads();
  std::vector<std::string> expected;
  for (int threads : {1, 2, 8}) {
    Parallel::shared().resize(threads);
    Log log;
    const auto folder = temporary.path() / ("run" + std::to_string(threads));
    const auto hashes = results(config, folder, log.messages);
    if (expected.empty()) expected = hashes;
    CHECK(hashes == expected);
    CHECK_FALSE(log.has("reused"));

    Log again;
    CHECK(results(config, folder, again.messages) == expected);
    for (const char* stage : {"features of tiny_xception: reused", "scores: reused", "SV-net: reused"})
      CHECK(again.has(stage));
    CHECK_FALSE(again.has("epoch"));
  }
  Parallel::shared().resize(threads_before);
}

TEST_CASE("a changed stage runs again, with the stages that depend on it and no others") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  Log first;
  const auto before = results(config, temporary.path() / "run", first.messages);
  config.training.learning_rate = 2e-3;
  Log log;
  const auto after = results(config, temporary.path() / "run", log.messages);
  CHECK(log.has("features of tiny_xception: reused"));
  CHECK(log.has("scores: reused"));
  CHECK(log.has("epoch 4/4"));
  CHECK(after[0] == before[0]);
  CHECK(after[1] == before[1]);
  CHECK(after[5] != before[5]);
}

TEST_CASE("an interrupted training resumes to the same bits") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  const auto expected = results(config, temporary.path() / "whole", {});
  struct Stop {};
  // The line of an epoch comes before its checkpoint is written: the third epoch is lost and repeated.
  const Messages stopping{.line =
                              [](std::string_view line) {
                                if (line.starts_with("epoch 3/")) throw Stop{};
                              },
                          .progress = {}};
  CHECK_THROWS_AS(results(config, temporary.path() / "run", stopping), Stop);
  CHECK_FALSE(std::filesystem::exists(temporary.path() / "run/model.safetensors"));
  Log log;
  CHECK(results(config, temporary.path() / "run", log.messages) == expected);
  CHECK(log.has("training: goes on after epoch 2"));
}

TEST_CASE("a run that was killed between its last checkpoint and metrics.csv writes the last row when it goes on") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  const std::filesystem::path run = temporary.path() / "run";
  const auto expected = results(config, run, {});
  const std::string metrics = file_contents(run / "metrics.csv");
  std::filesystem::remove(run / "model.safetensors");
  temporary.write("run/metrics.csv", metrics.substr(0, metrics.rfind('\n', metrics.size() - 2) + 1));
  CHECK(results(config, run, {}) == expected);
  CHECK(file_contents(run / "metrics.csv") == metrics);
}

TEST_CASE("a training that is interrupted after every step goes on to the same bits") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  const auto expected = results(config, temporary.path() / "whole", {});
  struct Stop {};
  Log log;
  Messages stopping = log.messages;  // the first report of progress comes after the first step
  stopping.progress = [](std::string_view task, Index, Index, double) {
    if (task == "training") throw Stop{};
  };
  constexpr int kSteps = 4 * 5;
  std::vector<std::string> made;
  int interruptions = 0;
  for (; made.empty() && interruptions <= kSteps; ++interruptions) try {
      made = results(config, temporary.path() / "run", stopping);
    } catch (const Stop&) {
    }
  CHECK(made == expected);
  CHECK(interruptions == kSteps + 1);
  CHECK(log.has("training: goes on after epoch 0 and 3 steps of the next"));
  CHECK(log.has("training: goes on after epoch 2 and 1 steps of the next"));
  CHECK(log.has("training: goes on after epoch 3"));
}

TEST_CASE("with validation categories the epoch that ranks their views best is kept, and training stops in time") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.training.validation_categories = 1;
  config.training.epochs = 40;
  config.training.patience = 2;
  config.training.target = GENERATE(TargetScale::scaled, TargetScale::centred);
  Log log;
  const auto folder = temporary.path() / "run";
  const auto expected = results(config, folder, log.messages);
  CHECK(log.has("within poses Spearman"));
  CHECK(log.has("training stops: no better epoch than"));

  // metrics.csv: a line per epoch, the best one followed by two others.
  std::ifstream csv(folder / "metrics.csv");
  std::string line;
  std::getline(csv, line);
  CHECK(line == "epoch,step,learning_rate,loss,validation_loss,validation_spearman,validation_regret");
  std::vector<double> spearman;
  while (std::getline(csv, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    REQUIRE(cells.size() == 7);
    spearman.push_back(std::stod(cells[5]));
    CHECK(std::stod(cells[6]) >= 0);
  }
  REQUIRE(spearman.size() >= 3);
  CHECK(spearman.size() < 40);
  const auto best = std::max_element(spearman.begin(), spearman.end());
  CHECK(spearman.end() - best == 3);

  // A training that stopped is finished: nothing is trained again, and an interrupted one has the same bits.
  Log again;
  CHECK(results(config, folder, again.messages) == expected);
  CHECK_FALSE(again.has("epoch"));
  struct Stop {};
  const Messages stopping{.line =
                              [](std::string_view said) {
                                if (said.starts_with("epoch 2/")) throw Stop{};
                              },
                          .progress = {}};
  CHECK_THROWS_AS(results(config, temporary.path() / "resumed", stopping), Stop);
  CHECK(results(config, temporary.path() / "resumed", {}) == expected);
}

TEST_CASE("a backbone is trained with its head, the same for any number of threads, and interrupted or not") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.training.fine_tune = GENERATE(FineTune::last_block, FineTune::all);
  config.training.epochs = 2;
  config.training.validation_categories = 1;
  const bool all = config.training.fine_tune == FineTune::all;
  const int threads_before = Parallel::shared().threads();
  std::vector<std::string> expected;
  for (int threads : {1, 2, 8}) {
    Parallel::shared().resize(threads);
    const auto hashes = results(config, temporary.path() / ("run" + std::to_string(threads)), {});
    if (expected.empty()) expected = hashes;
    CHECK(hashes == expected);
  }
  Parallel::shared().resize(threads_before);

  struct Stop {};
  const Messages stopping{.line =
                              [](std::string_view line) {
                                if (line.starts_with("epoch 2/")) throw Stop{};
                              },
                          .progress = {}};
  CHECK_THROWS_AS(results(config, temporary.path() / "resumed", stopping), Stop);
  Log log;
  CHECK(results(config, temporary.path() / "resumed", log.messages) == expected);
  CHECK(log.has("training: goes on after epoch 1"));

  // Frozen layers keep their bits, trained layers do not.
  const Model model = read_model(temporary.path() / "run1/model.safetensors");
  const Backbone untrained = backbone_from_folder("tiny_xception", "", {}, 3).backbone;
  const auto above = untrained.graph().ancestors({untrained.graph().find("block4_act")});
  for (std::size_t i = 0; i < above.size(); ++i) {
    const GraphNode& node = untrained.graph().nodes()[i];
    for (const auto& spec : node.parameters) {
      const auto before = untrained.parameters().at(node.parameter_name(spec)).values<float>(),
                 after = model.backbone_parameters.at(node.parameter_name(spec)).values<float>();
      INFO(node.parameter_name(spec));
      CHECK(std::equal(before.begin(), before.end(), after.begin(), after.end()) == (!all && above[i]));
    }
  }

  // Evaluation and prediction use the features of the trained backbone.
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  Stages run(config, dataset, temporary.path() / "run1", {});
  const std::vector<double> scores = run.predicted_scores(model);
  const Predictor predictor(temporary.path() / "run1/model.safetensors");
  for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose) {
    const Image top =
        read_image(dataset.root / dataset.views[static_cast<std::size_t>(dataset.poses[pose].top_view)].path);
    for (const View& view : dataset.views_of(static_cast<Index>(pose))) {
      const CameraPose camera{static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)};
      const float predicted = predictor.scores(predictor.embed(top), std::span(&camera, 1))[0];
      CHECK(scores[static_cast<std::size_t>(&view - dataset.views.data())] == Approx(predicted).epsilon(1e-4));
    }
    const Tensor found = predictor.embed(top), old = untrained.features(untrained.batch(std::span(&top, 1)));
    CHECK_FALSE(std::equal(old.data<float>(), old.data<float>() + old.size(), found.data<float>()));
  }
}

TEST_CASE("top images in every orientation give eight times the examples, the same for any number of threads",
          "[slow]") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.training.fine_tune = GENERATE(FineTune::none, FineTune::last_block, FineTune::all);
  config.training.epochs = 1;
  const auto examples = [&](const std::string& folder) {
    Log log;
    Stages(config, read_view_dataset(config.dataset.root), temporary.path() / folder, log.messages).model();
    for (const auto& line : log.lines)
      if (line.starts_with("SV-net: ")) return std::stoi(line.substr(line.find(", ") + 2));
    return 0;
  };
  const int as_taken = examples("plain");
  CHECK(as_taken > 0);
  config.training.augmentation = TopViewAugmentation::turns;
  CHECK(examples("plain") == 8 * as_taken);  // and the model of "plain" is not reused

  const int threads_before = Parallel::shared().threads();
  std::vector<std::string> expected;
  for (int threads : {1, 3}) {
    Parallel::shared().resize(threads);
    const auto hashes = results(config, temporary.path() / ("run" + std::to_string(threads)), {});
    if (expected.empty()) expected = hashes;
    CHECK(hashes == expected);
  }
  Parallel::shared().resize(threads_before);
}

TEST_CASE("scores of all orientations equal those of the predictor, with a model of their own") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.sv_net.angles = AngleEncoding::harmonics;
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  const Model as_taken = Stages(config, dataset, temporary.path() / "run", {}).model();
  CHECK(as_taken.symmetries == 1);

  config.sv_net.orientations = Orientations::all;
  Stages run(config, dataset, temporary.path() / "run", {});
  const Model model = run.model();
  CHECK(model.symmetries == 8);
  CHECK(model.input_fingerprint != as_taken.input_fingerprint);
  const std::vector<double> scores = run.predicted_scores(model);
  REQUIRE(scores.size() == dataset.views.size());
  CHECK(scores != run.predicted_scores(as_taken));
  const Predictor predictor(temporary.path() / "run/model.safetensors");
  for (std::size_t pose = 0; pose < dataset.poses.size(); ++pose) {
    const Tensor features = predictor.embed(
        read_image(dataset.root / dataset.views[static_cast<std::size_t>(dataset.poses[pose].top_view)].path));
    for (const View& view : dataset.views_of(static_cast<Index>(pose))) {
      const CameraPose camera{static_cast<double>(view.theta_deg), static_cast<double>(view.phi_deg)};
      CHECK(scores[static_cast<std::size_t>(&view - dataset.views.data())] ==
            Approx(predictor.scores(features, std::span(&camera, 1))[0]).epsilon(1e-4));
    }
  }
}

TEST_CASE("inputs cached in every orientation equal those made on request") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const ViewDataset dataset = read_view_dataset(temporary.path() / "data");
  const Backbone backbone = random_backbone("tiny_xception", "block4_act", 3);
  const auto frozen =
      std::make_shared<Inference>(backbone.graph(), backbone.parameters(), backbone.graph().find("block4_act"));
  ImageInputs inputs(dataset, backbone.preprocessing(), frozen, {.orientations = 8, .flat = true});
  const std::vector<Index> wanted{9, 8, 15};  // of view 1
  const Tensor made = inputs.batch(wanted);
  inputs.keep({1}, {}, SingleProcess::shared());
  const Tensor kept = inputs.batch(wanted);
  CHECK(made.shape() == kept.shape());
  CHECK(std::ranges::equal(made.values<float>(), kept.values<float>()));
  const Tensor as_taken =
      ImageInputs(dataset, backbone.preprocessing(), frozen, {.flat = true}).batch(std::vector<Index>{1});
  const auto row = [&](Index i) {
    return made.values<float>().subspan(static_cast<std::size_t>(i * made.dim(1)),
                                        static_cast<std::size_t>(made.dim(1)));
  };
  CHECK(std::ranges::equal(row(1), as_taken.values<float>()));
  CHECK_FALSE(std::ranges::equal(row(0), row(1)));
}

TEST_CASE("a stage with a damaged file is repeated") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  const auto expected = results(config, temporary.path() / "run", {});
  for (const char* name : {"features-tiny_xception.h5", "scores.h5", "model.safetensors"})
    std::filesystem::resize_file(temporary.path() / "run" / name,
                                 std::filesystem::file_size(temporary.path() / "run" / name) / 2);
  Log log;
  CHECK(results(config, temporary.path() / "run", log.messages) == expected);
  CHECK(log.has("made again"));
}

TEST_CASE("scores leave out held-out categories") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const Config config = small_config(temporary.path() / "data");
  Stages run(config, read_view_dataset(config.dataset.root), temporary.path() / "run", {});
  const Scores& scores = run.scores();
  for (std::size_t i = 0; i < scores.paths.size(); ++i) {
    const bool held_out = scores.paths[i].starts_with("ring/");
    CHECK((scores.count[i] == 0) == held_out);
    CHECK(std::isnan(scores.scaled[i]) == held_out);
  }
}

TEST_CASE("scores resume from the snapshot of an interrupted run") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.scores.problems = 5000;
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  Stages whole(config, dataset, temporary.path() / "whole", {});
  whole.scores();

  struct Stop {};
  // The last step is reported before its snapshot is written: it is lost and repeated.
  const Messages stopping{.line = {}, .progress = [](std::string_view, Index done, Index total, double) {
                            if (done == total) throw Stop{};
                          }};
  const auto path = temporary.path() / "run/scores.h5";
  Log log;
  Stages run(config, dataset, temporary.path() / "run", log.messages);
  CHECK_THROWS_AS(make_scores(path, dataset, whole.features("tiny_xception", ""), {false, false, false, true}, config,
                              stopping, {.snapshot_seconds = 0}),
                  Stop);
  CHECK_FALSE(std::filesystem::exists(path));
  REQUIRE(std::filesystem::exists(snapshot_path(path)));

  SECTION("of the same scores") {
    run.scores();
    CHECK(log.has("resumed after "));
    CHECK(file_sha256(path) == file_sha256(temporary.path() / "whole/scores.h5"));
  }
  SECTION("not of other scores") {
    config.seed = 4;
    Stages(config, dataset, temporary.path() / "run", log.messages).scores();
    CHECK_FALSE(log.has("resumed"));
  }
  SECTION("not of a damaged one") {
    std::filesystem::resize_file(snapshot_path(path), 100);
    run.scores();
    CHECK(log.has("made again"));
    CHECK(file_sha256(path) == file_sha256(temporary.path() / "whole/scores.h5"));
  }
  CHECK_FALSE(std::filesystem::exists(snapshot_path(path)));
}

TEST_CASE("a run in int8 leaves a model that predicts with the backbone that it was trained with") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  const InferenceOptions int8{.precision = kernels::Precision::int8};
  const auto folder = temporary.path() / "run";
  Log log;
  const Run run = make_run(config, dataset, folder, log.messages, SingleProcess::shared(), int8);
  FeaturesStage stage(run);
  const Features& features = stage.features("tiny_xception", "");
  CHECK_THAT(features.preprocessing, Catch::Contains(", products in int8, ranges "));
  const Scores scores = scores_stage(run, stage);
  static_cast<void>(model_stage(run, stage, scores));
  const Model model = read_model(folder / "model.safetensors");
  REQUIRE(model.backbone_ranges != nullptr);
  const Predictor predictor(model);
  for (const auto& pose : dataset.poses) {
    const auto top = static_cast<std::size_t>(pose.top_view);
    const Tensor embedded = predictor.embed(read_image(dataset.root / dataset.views[top].path));
    CHECK(std::equal(embedded.data<float>(), embedded.data<float>() + embedded.size(),
                     features.values.begin() + static_cast<std::ptrdiff_t>(top) * features.dimension));
  }
  // The same ranges again: everything is reused.
  Log again;
  const Run second = make_run(config, dataset, folder, again.messages, SingleProcess::shared(), int8);
  FeaturesStage same(second);
  static_cast<void>(model_stage(second, same, scores_stage(second, same)));
  for (const char* what : {"features of tiny_xception: reused", "scores: reused", "SV-net: reused"})
    CHECK(again.has(what));
  config.training.fine_tune = FineTune::last_block;
  CHECK_THROWS_WITH(make_run(config, dataset, folder, {}, SingleProcess::shared(), int8),
                    Catch::StartsWith("training.fine_tune: with SVNET_PRECISION=int8"));
}

TEST_CASE("calibration takes evenly spaced views and refuses a dataset without any") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  const ViewDataset dataset = read_view_dataset(temporary.path() / "data");
  const BackboneWithOrigin exact = backbone_from_folder("tiny_xception", "", {}, 1);
  const auto ranges = [&](const ViewDataset& from, Index images) {
    return *calibrated(exact, from, images, {}).backbone.network().options().ranges;
  };
  ViewDataset two = dataset;
  two.views = {dataset.views[0], dataset.views[dataset.views.size() / 2]};
  CHECK(ranges(dataset, 2) == ranges(two, 64));
  CHECK(ranges(dataset, 3) != ranges(two, 64));
  ViewDataset none = dataset;
  none.views.clear();
  CHECK_THROWS_WITH(ranges(none, 64), "[calibration] there are no pictures");
}

TEST_CASE("a dry run leaves no file") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  Log log;
  dry_run(config, read_view_dataset(config.dataset.root), log.messages);
  CHECK(log.has("epoch 1/1"));
  config.training.fine_tune = FineTune::all;
  Log tuned;
  dry_run(config, read_view_dataset(config.dataset.root), tuned.messages);
  CHECK(tuned.has("epoch 1/1"));
}

TEST_CASE("a configuration that does not fit the dataset is refused") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  const auto run = [&] { make_run(config, dataset, temporary.path() / "run", {}); };
  config.dataset.held_out = {"rings"};
  CHECK_THROWS_WITH(run(), "dataset.held_out: the dataset has no category 'rings', did you mean 'ring'?");
  config.dataset.held_out = {"ring", "cube", "cone"};
  CHECK_THROWS_WITH(run(), "dataset.held_out: leaves 1 categories to train on, at least 2 are needed");
  config.dataset.held_out = {"ring"};
  config.training.validation_categories = 2;
  CHECK_THROWS_WITH(run(), "training.validation_categories: 2 of 3 training categories leave fewer than 2 to train on");
  config.training.validation_categories = 0;
  config.sv_net.backbone = "resnet";
  CHECK_THROWS_WITH(run(), Catch::Contains("there is no backbone 'resnet'"));
  config.sv_net.backbone = "tiny_xception";
  config.sv_net.layer = "block9";
  CHECK_THROWS_WITH(run(), Catch::Contains("no layer 'block9'"));
  config.sv_net.layer = "block4_act";
  config.training.fine_tune = FineTune::last_block;
  CHECK_THROWS_WITH(run(),
                    "training.fine_tune: last_block, but sv_net.layer 'block4_act' is not above the input of the last "
                    "block of tiny_xception, which is the output of 'block4_act'");
  config.training.fine_tune = FineTune::none;
  config.sv_net.layer = "";
  config.evaluation.pipelines = {"foo_ward"};
  CHECK_THROWS_WITH(run(), Catch::Contains("there is no backbone 'foo'"));
  config.evaluation.pipelines = {"tiny_xception_ward"};
  config.scores.min_objects = 3;
  CHECK_THROWS_WITH(run(), Catch::Contains("category 'ball' has 2 objects, fewer than min_objects, 3"));
  CHECK_FALSE(std::filesystem::exists(temporary.path() / "run/config.yaml"));
}

TEST_CASE("a contact sheet of held-out objects is written if categories are held out") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  results(config, temporary.path() / "one", {});
  CHECK_FALSE(Stages(config, read_view_dataset(config.dataset.root), temporary.path() / "one", {}).contact_sheet(20));
  CHECK_FALSE(std::filesystem::exists(temporary.path() / "one/views.png"));
  config.dataset.held_out = {"ring", "ball"};
  results(config, temporary.path() / "two", {});
  const auto sheet =
      Stages(config, read_view_dataset(config.dataset.root), temporary.path() / "two", {}).contact_sheet(20);
  REQUIRE(sheet == temporary.path() / "two/views.png");
  CHECK(read_image(*sheet).width == 20 + 2 * (3 * 116 + 20));
}

TEST_CASE("the tables have the selectors that the configuration names, else those of their categories") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  config.dataset.held_out = {"ring", "ball"};
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  Stages trained(config, dataset, temporary.path() / "run", {});
  trained.model();
  const auto selectors_of = [&](const std::string& split) {
    return Stages(config, dataset, temporary.path() / "run", {}).evaluation(20).at(split).selectors;
  };
  CHECK(selectors_of("training") == std::vector<std::string>{"top", "rand", "opt_glob", "opt_ind"});
  CHECK(selectors_of("held_out") == std::vector<std::string>{"top", "rand", "svnet"});
  config.evaluation.selectors = {"opt_ind", "svnet"};
  CHECK(selectors_of("training") == config.evaluation.selectors);
  CHECK(selectors_of("held_out") == config.evaluation.selectors);
  config.evaluation.selectors = {"opt_int"};
  CHECK_THROWS_WITH(selectors_of("training"),
                    "evaluation.selectors: there is no selector 'opt_int', did you mean 'opt_ind'?");
}

TEST_CASE("weights come from the folder, otherwise they are built in, otherwise random") {
  const TemporaryFolder temporary;
  const auto folder = temporary.path();
  const auto weights = [](const BackboneWithOrigin& from) { return from.weights; };
  const std::string built_in = built_in_backbone("tiny_xception")->sha256;
  CHECK(weights(backbone_from_folder("tiny_xception", "", {}, 7)) == built_in);
  CHECK(weights(backbone_from_folder("tiny_xception", "", folder, 7)) == built_in);
  CHECK(weights(backbone_from_folder("mobilenet", "", {}, 7)) == "random, seed 7");
  CHECK_THROWS_WITH(backbone_from_folder("mobilenet", "", folder, 7),
                    folder.string() +
                        ": no weights of mobilenet; put one of these files there: mobilenet.safetensors, "
                        "mobilenet_1_0_224_tf_no_top.h5, mobilenet_1_0_224_tf.h5");
  write_backbone(folder / "tiny_xception.safetensors", random_backbone("tiny_xception", "", 2), "");
  CHECK(weights(backbone_from_folder("tiny_xception", "", folder, 7)) ==
        file_sha256(folder / "tiny_xception.safetensors"));
}

TEST_CASE("evaluating never trains") {
  const TemporaryFolder temporary;
  write_small_dataset(temporary.path() / "data");
  Config config = small_config(temporary.path() / "data");
  const auto evaluate = [&] {
    Stages(config, read_view_dataset(config.dataset.root), temporary.path() / "run", {}).evaluation(10);
  };
  CHECK_THROWS_WITH(evaluate(),
                    (temporary.path() / "run").string() + ": holds no trained model; run svnet-train first");
  const auto before = results(config, temporary.path() / "run", {});
  config.training.epochs = 5;
  CHECK_THROWS_WITH(evaluate(), Catch::Contains("model.safetensors: was trained with another configuration"));
  CHECK(file_sha256(temporary.path() / "run/model.safetensors") == before[5]);
}
