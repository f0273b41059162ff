#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/parallel.h"
#include "io/files/file_hash.h"
#include "io/files/snapshot_path.h"
#include "io/views/dataset_folder.h"
#include "semantics/on_policy_weights.h"
#include "small_dataset.h"
#include "small_run.h"
#include "train/stages/made_scores.h"
#include "train/stages/model.h"
#include "train/stages/scores.h"

using namespace svnet;
using namespace svnet::io;
using namespace svnet::train;

namespace {

namespace fs = std::filesystem;

/// The small dataset, and the stages of configurations on it, each in a run folder.
class Scene {
 public:
  Scene() { write_small_dataset(folder.path() / "data"); }

  Scores scores(const Config& config, const fs::path& name, const Messages& messages = {}) const {
    const Run run = make_run(config, read_view_dataset(config.dataset.root), folder.path() / name, messages);
    FeaturesStage features(run);
    return scores_stage(run, features);
  }
  Scores scores(const Config& config, const fs::path& name, const RoundPredictor& predict,
                const Messages& messages = {}) const {
    const Run run = make_run(config, read_view_dataset(config.dataset.root), folder.path() / name, messages);
    FeaturesStage features(run);
    return scores_stage(run, features, predict);
  }
  std::string hash(const fs::path& file) const { return file_sha256(folder.path() / file); }
  bool has(const fs::path& file) const { return fs::exists(folder.path() / file); }

  TemporaryFolder folder;
  Config defaults = small_config(folder.path() / "data");
};

/// Likes the views at 45 degrees, which tell categories apart.
std::vector<double> likes_telling_views(const Scores& scores) {
  std::vector<double> predicted;
  for (const std::string& path : scores.paths) predicted.push_back(path.find("/45_") == std::string::npos ? 0 : 1);
  return predicted;
}

}  // namespace

TEST_CASE("scores of two backbones are the mean of the scores of each") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.backbones = {"tiny_xception", "mobilenet_v2"};
  Log log;
  const Scores mean = scene.scores(config, "both", log.messages);
  const Scores first = read_scores(scene.folder.path() / "both/scores-tiny_xception.h5"),
               second = read_scores(scene.folder.path() / "both/scores-mobilenet_v2.h5");
  for (std::size_t v = 0; v < mean.paths.size(); ++v) {
    INFO(mean.paths[v]);
    CHECK(mean.count[v] == std::min(first.count[v], second.count[v]));
    if (mean.paths[v].starts_with("ring/")) {  // held out
      CHECK(std::isnan(mean.individual[v]));
      continue;
    }
    CHECK(mean.individual[v] == Approx((first.individual[v] + second.individual[v]) / 2).epsilon(1e-14));
    CHECK(mean.global[v] == Approx((first.global[v] + second.global[v]) / 2).epsilon(1e-14));
    CHECK(mean.standard_error[v] == Approx((first.standard_error[v] + second.standard_error[v]) / 2).epsilon(1e-14));
    CHECK(mean.rank_stability[v] == Approx((first.rank_stability[v] + second.rank_stability[v]) / 2).epsilon(1e-14));
    CHECK((mean.scaled[v] >= 0 && mean.scaled[v] <= 1));
  }
  CHECK(mean.problems == 300);
  CHECK(mean.sampler == first.sampler + "; mean of tiny_xception, mobilenet_v2");
  CHECK(scene.hash("both/scores.h5") != scene.hash("both/scores-tiny_xception.h5"));

  // Those of each backbone are the scores of a run with that backbone alone.
  scene.scores(scene.defaults, "one");
  CHECK(scene.hash("one/scores.h5") == scene.hash("both/scores-tiny_xception.h5"));
  CHECK_FALSE(scene.has("one/scores-tiny_xception.h5"));
  config.scores.backbones = {"tiny_xception"};
  Log again;
  scene.scores(config, "one", again.messages);
  CHECK(again.has("scores: reused scores.h5"));
}

TEST_CASE("scores of several backbones are reused, and made again one by one") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.backbones = {"tiny_xception", "mobilenet_v2"};
  scene.scores(config, "run");
  const std::string expected = scene.hash("run/scores.h5");
  Log reused;
  scene.scores(config, "run", reused.messages);
  CHECK(reused.has("scores: reused scores.h5"));

  fs::remove(scene.folder.path() / "run/scores.h5");
  fs::remove(scene.folder.path() / "run/scores-mobilenet_v2.h5");
  Log log;
  scene.scores(config, "run", log.messages);
  CHECK(log.has("scores of tiny_xception: reused scores-tiny_xception.h5"));
  CHECK_FALSE(log.has("scores of mobilenet_v2: reused"));
  CHECK(scene.hash("run/scores.h5") == expected);

  config.scores.backbones = {"mobilenet_v2",
                             "tiny_xception"};  // another sum, and other scores as far as files can tell
  Log other;
  scene.scores(config, "run", other.messages);
  CHECK_FALSE(other.has("scores: reused"));
  CHECK(other.has("scores of mobilenet_v2: reused"));
}

TEST_CASE("in a round, views are drawn as the predictions of the scores before say") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.rounds = 2;
  config.scores.problems = 5000;
  std::vector<std::string> trained_on;
  const RoundPredictor predict = [&](const Scores& scores) {
    trained_on.push_back(scores.input_fingerprint);
    return likes_telling_views(scores);
  };
  const Scores scores = scene.scores(config, "run", predict);
  const Scores uniform = read_scores(scene.folder.path() / "run/scores.h5"),
               first = read_scores(scene.folder.path() / "run/scores-round-1.h5");
  CHECK(trained_on == std::vector{uniform.input_fingerprint, first.input_fingerprint});
  CHECK(first.input_fingerprint != uniform.input_fingerprint);
  // The predictor ignores the scores: the same weights again, and so the same scores.
  CHECK(scores.input_fingerprint == first.input_fingerprint);
  CHECK(scores.count == first.count);
  CHECK(scene.hash("run/scores-round-2.h5") == scene.hash("run/scores-round-1.h5"));
  CHECK(uniform.sampler == "uniform; categories 2 to all, objects 1 to all, one pose, one view; singletons zero");
  CHECK(first.sampler ==
        "uniform; categories 2 to all, objects 1 to all, one pose, one view on-policy (softmax of predictions over "
        "effectively 0.2 of the views, 0.25 uniform); singletons zero");

  double liked = 0, others = 0, gain = 0;
  for (std::size_t v = 0; v < scores.paths.size(); ++v) {
    if (scores.count[v] == 0) continue;
    const bool telling = scores.paths[v].find("/45_") != std::string::npos;
    (telling ? liked : others) += static_cast<double>(scores.count[v]);
    if (telling) gain += scores.individual[v] - uniform.individual[v];
  }
  CHECK(liked / (liked + others) == Approx(0.875).margin(0.01));  // .75 and half of .25
  CHECK(gain > 0);  // among others that tell categories apart, the views are clustered better

  // A run without rounds reuses the uniform scores, and leaves the others.
  config.scores.rounds = 0;
  Log log;
  CHECK(scene.scores(config, "run", log.messages).count == uniform.count);
  CHECK(log.has("scores: reused scores.h5"));
}

TEST_CASE("rounds are reused while the predictions keep their bits") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.rounds = 1;
  double liking = 1;
  const RoundPredictor predict = [&](const Scores& scores) {
    std::vector<double> predicted = likes_telling_views(scores);
    predicted[0] = liking;
    return predicted;
  };
  scene.scores(config, "run", predict);
  Log same, other;
  scene.scores(config, "run", predict, same.messages);
  CHECK(same.has("scores, round 1: reused scores-round-1.h5"));
  liking = 0;
  scene.scores(config, "run", predict, other.messages);
  CHECK(other.has("scores: reused scores.h5"));
  CHECK_FALSE(other.has("scores, round 1: reused"));
  CHECK_THROWS_WITH(scene.scores(config, "run", [](const Scores&) { return std::vector<double>(3); }),
                    "[scores] 3 predictions of 32 views");
}

TEST_CASE("a round resumes from its snapshot") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.rounds = 1;
  config.scores.problems = 5000;
  scene.scores(config, "whole", likes_telling_views);
  struct Stop {};
  const ViewDataset dataset = read_view_dataset(config.dataset.root);
  const Run run = make_run(config, dataset, scene.folder.path() / "run", {});
  FeaturesStage features(run);
  std::vector<std::int32_t> poses;
  for (const View& view : dataset.views) poses.push_back(static_cast<std::int32_t>(view.pose));
  const auto uniform = read_scores(scene.folder.path() / "whole/scores.h5");
  const auto weights = semantics::on_policy_weights(likes_telling_views(uniform), poses);
  const fs::path path = scene.folder.path() / "run/scores-round-1.h5";
  const Messages stopping{.line = {}, .progress = [](std::string_view, Index done, Index total, double) {
                            if (done == total) throw Stop{};
                          }};
  CHECK_THROWS_AS(make_scores(path, dataset, features.features("tiny_xception", ""), run.held_out, config, stopping,
                              {.snapshot_seconds = 0}, weights),
                  Stop);
  REQUIRE(fs::exists(snapshot_path(path)));
  Log log;
  scene.scores(config, "run", likes_telling_views, log.messages);
  CHECK(log.has("resumed after "));
  CHECK(scene.hash("run/scores-round-1.h5") == scene.hash("whole/scores-round-1.h5"));
  CHECK_FALSE(fs::exists(snapshot_path(path)));
}

TEST_CASE("rounds of several backbones run end to end, the same for any number of threads, and resume", "[slow]") {
  const Scene scene;
  Config config = scene.defaults;
  config.scores.rounds = 2;
  config.scores.backbones = {"tiny_xception", "mobilenet_v2"};
  config.training.epochs = 2;
  const auto train_in = [&](const fs::path& name, const Messages& messages) {
    const Run run = make_run(config, read_view_dataset(config.dataset.root), scene.folder.path() / name, messages);
    FeaturesStage features(run);
    const Scores scores = scores_stage(run, features);
    model_stage(run, features, scores);
    CHECK(trained_model(run, features).input_fingerprint ==
          read_model(scene.folder.path() / name / "model.safetensors").input_fingerprint);
    std::vector<std::string> hashes;
    for (const char* file : {"scores.h5", "scores-round-1.h5", "scores-round-2.h5", "scores-mobilenet_v2-round-2.h5",
                             "round-1/model.safetensors", "round-2/model.safetensors", "model.safetensors"})
      hashes.push_back(scene.hash(name / file));
    return hashes;
  };
  const int threads_before = Parallel::shared().threads();
  Parallel::shared().resize(1);
  const auto expected = train_in("one", {});
  CHECK(expected[0] != expected[1]);
  Parallel::shared().resize(3);
  CHECK(train_in("three", {}) == expected);
  Parallel::shared().resize(threads_before);

  struct Stop {};
  const Messages stopping{.line =
                              [](std::string_view line) {
                                if (line.starts_with("scores, round 2 of 2")) throw Stop{};
                              },
                          .progress = {}};
  CHECK_THROWS_AS(train_in("stopped", stopping), Stop);
  Log log;
  CHECK(train_in("stopped", log.messages) == expected);
  CHECK(log.has("scores, round 1: reused scores-round-1.h5"));
  CHECK_FALSE(log.has("scores, round 2: reused"));

  // With another round, those before are reused; the model is another.
  config.scores.rounds = 3;
  Log more;
  CHECK(train_in("stopped", more.messages).back() != expected.back());
  CHECK(more.has("scores, round 2: reused scores-round-2.h5"));
  CHECK_FALSE(more.has("scores, round 3: reused"));
}
