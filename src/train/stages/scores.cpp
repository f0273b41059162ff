#include "train/stages/scores.h"

#include <bit>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/files/snapshot_path.h"
#include "semantics/mean_scores.h"
#include "semantics/on_policy_weights.h"
#include "semantics/semantic_scores.h"
#include "train/config/fingerprint.h"
#include "train/random_problems.h"
#include "train/stages/made_scores.h"
#include "train/stages/options.h"
#include "train/stages/resumed_sums.h"
#include "train/stages/reuse_or_make.h"

namespace svnet::train {
using semantics::ScoreSums;
using semantics::ViewWeights;

namespace {

/// The configuration of the scores in a file: the number of rounds counts through the weights alone.
Config of_one_round(Config config) {
  config.scores.rounds = 0;
  return config;
}

std::string file_fingerprint(const std::string& features, const ViewWeights& weights, const Config& config) {
  return weights.empty() ? scores_fingerprint(features, of_one_round(config))
                         : scores_fingerprint(features, weights, of_one_round(config));
}

/// One round of the stage.
struct Round {
  Index number = 0;
  ViewWeights weights{};  ///< empty in round 0: uniform

  /// The file of the scores of a backbone, or of all if it is "".
  std::string file_name(const std::string& backbone) const {
    return joined("scores", backbone.empty() ? "" : "-", backbone, number == 0 ? "" : joined("-round-", number), ".h5");
  }
  /// What messages call these scores.
  std::string content(const std::string& backbone) const {
    return joined("scores", backbone.empty() ? "" : " of ", backbone, number == 0 ? "" : joined(", round ", number));
  }
};

/// The scores by one backbone. `name` is what their file is named after: the backbone, or "" if there is only one.
Scores scores_of_backbone(const Run& run, FeaturesStage& stage, const std::string& backbone, const std::string& name,
                          const Round& round) {
  const Features& features = stage.features(backbone, scored_layer(run.config.scores, backbone));
  const StageFile file{.path = run.folder / round.file_name(name),
                       .fingerprint = file_fingerprint(features.input_fingerprint, round.weights, run.config),
                       .content = round.content(name)};
  const auto make = [&] {
    return make_scores(file.path, run.dataset, features, run.held_out, run.config, run.messages,
                       {.resume = Resume::same, .communicator = run.communicator}, round.weights);
  };
  return reuse_or_make(run, file, io::read_scores, make, write_made_scores);
}

Scores scores_of_round(const Run& run, FeaturesStage& stage, const Round& round) {
  const Config& config = run.config;
  const std::vector<std::string> backbones = scored_backbones(config.scores);
  if (backbones.size() == 1) return scores_of_backbone(run, stage, backbones[0], "", round);
  std::vector<std::string> fingerprints;
  for (const std::string& backbone : backbones)
    fingerprints.push_back(
        file_fingerprint(stage.fingerprint(backbone, scored_layer(config.scores, backbone)), round.weights, config));
  const StageFile file{.path = run.folder / round.file_name(""),
                       .fingerprint = mean_scores_fingerprint(fingerprints, of_one_round(config)),
                       .content = round.content("")};
  const auto make = [&] {
    std::vector<Scores> parts;
    for (const std::string& backbone : backbones)
      parts.push_back(scores_of_backbone(run, stage, backbone, backbone, round));
    return mean_of_backbones(parts, backbones, run.dataset.pose_of_view(), file.fingerprint);
  };
  return reuse_or_make(run, file, io::read_scores, make, io::write_scores);
}

/// The weights of the root process, in every process: a last bit that differs would end in different problems.
void broadcast(ViewWeights& weights, Communicator& communicator) {
  std::vector<std::uint64_t> bits(weights.size(), 0);
  if (communicator.is_root())
    for (std::size_t v = 0; v < weights.size(); ++v) bits[v] = std::bit_cast<std::uint64_t>(weights[v]);
  communicator.all_reduce(bits);
  for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = std::bit_cast<double>(bits[v]);
}

}  // namespace

Scores make_scores(const std::filesystem::path& path, const ViewDataset& dataset, const Features& features,
                   const std::vector<bool>& excluded, const Config& config, const Messages& messages,
                   const ScoringOptions& how, const ViewWeights& weights) {
  Config::Scores drawn = config.scores;
  drawn.min_categories = fewest_categories(excluded, drawn);
  const semantics::DistanceMatrix distances = semantics::squared_distances(
      features.values.data(), features.count, features.dimension, Parallel::shared(), how.communicator);
  const semantics::ClusteringProblems problems = clustering_problems(dataset, excluded, drawn, weights);
  const semantics::ScoreOptions options = score_options(config, features.dimension);
  const std::string fingerprint = file_fingerprint(features.input_fingerprint, weights, config);

  const ScoreSums sums = resumed_sums(
      path, fingerprint, problems.views(), messages, how, [&](ScoreSums& to, const semantics::ScoreProgress& progress) {
        continue_scores(distances, problems, options, Parallel::shared(), how.communicator, to, progress);
      });
  return scores_of_sums(sums, problems.pose_of_view(),
                        {.seed = options.seed,
                         .sampler = sampler_text(drawn, !weights.empty()),
                         .clustering = name_of(drawn.clustering),
                         .metric = "fm",
                         .input_fingerprint = fingerprint},
                        features.paths);
}

Scores scores_stage(const Run& run, FeaturesStage& features, const RoundPredictor& predict) {
  Scores scores = scores_of_round(run, features, {});
  for (Index number = 1; number <= run.config.scores.rounds; ++number) {
    run.say(joined("scores, round ", number, " of ", run.config.scores.rounds, ": views as a model of the scores of ",
                   number == 1 ? "uniform views" : joined("round ", number - 1), " chooses them"));
    const std::vector<double> predicted = predict(scores);
    check(predicted.size() == run.dataset.views.size(), "[scores] ", predicted.size(), " predictions of ",
          run.dataset.views.size(), " views");
    Round round{.number = number, .weights = semantics::on_policy_weights(predicted, run.dataset.pose_of_view())};
    broadcast(round.weights, run.communicator);
    scores = scores_of_round(run, features, round);
  }
  return scores;
}

Scores uniform_scores_stage(const Run& run, FeaturesStage& features) {
  Run uniform = run;
  uniform.config.scores.rounds = 0;
  return scores_stage(uniform, features);
}

Scores scores_stage(const Run& run, FeaturesStage& features) {
  return scores_stage(run, features, sv_net_round_predictor(run, features));
}

}  // namespace svnet::train
