#include "train/stages/plan.h"

#include <catch2/catch.hpp>
#include <functional>
#include <optional>

#include "io/views/dataset_folder.h"
#include "small_dataset.h"
#include "small_run.h"
#include "train/stages/model.h"
#include "train/stages/scores.h"
#include "train/stages/training_summary.h"

using namespace svnet;
using namespace svnet::train;

namespace {

const PlannedStage& stage_of(const std::vector<PlannedStage>& stages, const std::string& name) {
  for (const PlannedStage& stage : stages)
    if (stage.stage == name) return stage;
  FAIL("no stage " << name);
  return stages[0];
}

/// A run on the small dataset that is about to begin.
struct PlannedRun {
  explicit PlannedRun(const std::function<void(Config&)>& change) {
    write_small_dataset(temporary.path() / "data");
    Config config = small_config(temporary.path() / "data");
    config.scores.problems = 0;
    change(config);
    run.emplace(make_run(config, io::read_view_dataset(config.dataset.root, config.dataset.exif_orientation),
                         temporary.path() / "run", {}));
    features.emplace(*run);
  }

  TemporaryFolder temporary{};
  std::optional<Run> run{};
  std::optional<FeaturesStage> features{};
};

}  // namespace

TEST_CASE("a plan names the stages with their work and time, and says what is made") {
  PlannedRun planned([](Config& config) { config.scores.min_samples = 50; });
  const Run& run = *planned.run;
  FeaturesStage& features = *planned.features;

  auto stages = planned_stages(run, features);
  REQUIRE(stages.size() == 3);
  const PlannedStage &images = stage_of(stages, "features of tiny_xception"), &scores = stage_of(stages, "scores"),
                     &model = stage_of(stages, "SV-net");
  CHECK(images.work == "32 images");
  CHECK_FALSE(images.is_made);
  CHECK(images.seconds.value() > 0);
  CHECK_THAT(scores.work, Catch::EndsWith(" problems"));
  CHECK(scores.seconds.value() > 0);
  CHECK_THAT(model.work, Catch::StartsWith("4 epochs of "));
  CHECK(model.seconds.value() > 0);

  const Scores made = scores_stage(run, features);
  stages = planned_stages(run, features);
  CHECK(stage_of(stages, "features of tiny_xception").is_made);
  CHECK(stage_of(stages, "scores").is_made);
  CHECK_FALSE(stage_of(stages, "SV-net").is_made);

  const Model trained = model_stage(run, features, made);
  for (const PlannedStage& stage : planned_stages(run, features)) {
    CHECK(stage.is_made);
    CHECK_FALSE(stage.seconds.has_value());
  }
  const auto lines = training_summary(run, features, made, trained);
  REQUIRE(lines.size() == 8);
  CHECK(lines[0] == "SV-net learnt from 6 top views of 6 objects in 3 categories");
  CHECK_THAT(lines[1], Catch::EndsWith("in categories that it learnt from:"));
  CHECK_THAT(lines[2], Catch::StartsWith("  svnet"));
  CHECK_THAT(lines[7], Catch::StartsWith("  opt_ind"));
}

TEST_CASE("the time of scores is unknown if only their error stops them; with on-policy rounds they come again") {
  PlannedRun planned([](Config& config) {
    config.scores.target_error = 0.5;
    config.scores.rounds = 2;
  });
  const auto stages = planned_stages(*planned.run, *planned.features);
  const PlannedStage& scores = stage_of(stages, "scores");
  CHECK(scores.work == "problems until every standard error is at most 0.5, 3 times");
  CHECK_FALSE(scores.seconds.has_value());
}
