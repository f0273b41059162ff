#include "train/stages/scores.h"

#include <algorithm>
#include <bit>
#include <chrono>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/files/snapshot_path.h"
#include "semantics/mean_scores.h"
#include "semantics/on_policy_weights.h"
#include "semantics/semantic_scores.h"
#include "train/config/fingerprint.h"
#include "train/random_problems.h"
#include "train/stages/options.h"
#include "train/stages/reuse_or_make.h"

namespace svnet::train {
using semantics::ScoreSums;
using semantics::SemanticScores;
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

/// Puts the work of a snapshot into `sums`. Throws Error if `path` is no snapshot, or if it is one of other scores and
/// Resume is any; one of other scores is ignored if Resume is same.
void take_snapshot(const std::filesystem::path& path, const std::string& fingerprint, Resume how, ScoreSums& sums) {
  const io::ScoresSnapshot snapshot = io::read_scores_snapshot(path);
  if (how == Resume::same && snapshot.input_fingerprint != fingerprint) return;
  check(snapshot.input_fingerprint == fingerprint, path.string(),
        ": a snapshot of other scores (other features, options or seed); repeat the command that made it, or leave out "
        "--resume");
  const auto values = sums.values();
  const auto views = static_cast<Index>(sums.views.size());
  check(snapshot.views == views && snapshot.sums.size() == values.size(), path.string(), ": dataset 'sums': has ",
        snapshot.sums.size(), " numbers of ", snapshot.views, " views, expected ", values.size(), " of ", views);
  std::copy(snapshot.sums.begin(), snapshot.sums.end(), values.begin());
  sums.problems = static_cast<std::uint64_t>(snapshot.problems);
}

/// The sums to continue from, in every process: those of the snapshot, which the root process reads, or zeros.
ScoreSums first_sums(const std::filesystem::path& path, const std::string& fingerprint, Index views,
                     const Messages& messages, const ScoringOptions& options) {
  ScoreSums sums(views);
  if (options.resume == Resume::never) return sums;
  if (options.communicator.is_root() && std::filesystem::exists(path)) try {
      take_snapshot(path, fingerprint, options.resume, sums);
    } catch (const Error& error) {
      if (options.resume == Resume::any) throw;
      if (messages.line) messages.line(joined("made again: ", error.what()));
    }
  sums.problems = options.communicator.broadcast(sums.problems);
  if (sums.problems == 0) return sums;
  options.communicator.all_reduce(sums.values());
  if (messages.line) messages.line(joined("resumed after ", sums.problems, " problems"));
  return sums;
}

/// Writes a snapshot each time that the last one is old enough; none if the path is empty.
class Snapshots {
 public:
  Snapshots(const std::filesystem::path& path, double seconds, const std::string& fingerprint)
      : path_(path), seconds_(seconds), fingerprint_(fingerprint), last_(Clock::now()) {}

  void write_if_due(const ScoreSums& sums) {
    if (std::chrono::duration<double>(Clock::now() - last_).count() >= seconds_) write(sums);
  }

  void write(const ScoreSums& sums) {
    if (path_.empty()) return;
    const auto values = sums.values();
    io::write_scores_snapshot(path_, {fingerprint_,
                                      static_cast<Index>(sums.problems),
                                      static_cast<Index>(sums.views.size()),
                                      {values.begin(), values.end()}});
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path path_;
  double seconds_;
  std::string fingerprint_;
  Clock::time_point last_;
};

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

/// The mean of the scores of several backbones. Rank stability is the mean of theirs.
Scores mean_of(const std::vector<Scores>& parts, const std::vector<std::string>& backbones, const ViewDataset& dataset,
               const std::string& fingerprint) {
  std::vector<SemanticScores> values;
  for (const Scores& part : parts)
    values.push_back(
        {part.individual, part.global, part.count, part.standard_error, static_cast<std::uint64_t>(part.problems)});
  SemanticScores mean = semantics::mean_scores(values);
  Scores scores = parts[0];
  scores.problems = static_cast<Index>(mean.problems);
  scores.sampler += "; mean of " + joined_with(", ", backbones);
  scores.input_fingerprint = fingerprint;
  scores.individual = std::move(mean.individual);
  scores.global = std::move(mean.global);
  scores.count = std::move(mean.count);
  scores.standard_error = std::move(mean.standard_error);
  scores.scaled = semantics::scaled_per_pose(scores.individual, dataset.pose_of_view());
  for (std::size_t v = 0; v < scores.rank_stability.size(); ++v) {
    for (std::size_t i = 1; i < parts.size(); ++i) scores.rank_stability[v] += parts[i].rank_stability[v];
    scores.rank_stability[v] /= static_cast<double>(parts.size());
  }
  return scores;
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
    return mean_of(parts, backbones, run.dataset, file.fingerprint);
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

  const std::filesystem::path snapshot = io::snapshot_path(path);
  ScoreSums sums = first_sums(snapshot, fingerprint, problems.views(), messages, how);
  Snapshots snapshots(how.communicator.is_root() ? snapshot : std::filesystem::path(), how.snapshot_seconds,
                      fingerprint);
  try {
    continue_scores(distances, problems, options, Parallel::shared(), how.communicator, sums,
                    {&messages, [&](const ScoreSums& so_far) { snapshots.write_if_due(so_far); }});
  } catch (...) {
    snapshots.write(sums);  // the program is told to end, or something failed: the sums hold whole problems
    throw;
  }
  SemanticScores made = scores_from(sums);

  Scores scores{ScoresOrigin{.problems = static_cast<Index>(made.problems),
                             .seed = options.seed,
                             .sampler = sampler_text(drawn, !weights.empty()),
                             .clustering = name_of(drawn.clustering),
                             .metric = "fm",
                             .input_fingerprint = fingerprint},
                std::move(made.individual),
                std::move(made.global),
                {},
                std::move(made.count),
                std::move(made.standard_error),
                rank_stability(sums, problems.pose_of_view()),
                features.paths};
  scores.scaled = semantics::scaled_per_pose(scores.individual, problems.pose_of_view());
  return scores;
}

void write_made_scores(const std::filesystem::path& path, const Scores& scores) {
  io::write_scores(path, scores);
  std::error_code no_snapshot;
  std::filesystem::remove(io::snapshot_path(path), no_snapshot);
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
