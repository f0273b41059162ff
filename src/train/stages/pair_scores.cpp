#include "train/stages/pair_scores.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/random.h"
#include "base/text.h"
#include "io/views/scores_file.h"
#include "semantics/set_scores.h"
#include "train/config/fingerprint.h"
#include "train/random_problems.h"
#include "train/shuffled.h"
#include "train/stages/made_scores.h"
#include "train/stages/options.h"
#include "train/stages/resumed_sums.h"
#include "train/stages/reuse_or_make.h"

namespace svnet::train {
namespace {

std::vector<std::int32_t> poses_of(const ViewDataset& dataset, const semantics::ViewSets& pairs) {
  std::vector<std::int32_t> poses;
  for (Index i = 0; i < pairs.count(); ++i)
    poses.push_back(static_cast<std::int32_t>(dataset.views[static_cast<std::size_t>(pairs.set(i)[0])].pose));
  return poses;
}

std::vector<std::string> paths_of(const ViewDataset& dataset, const semantics::ViewSets& pairs) {
  const auto path = [&](std::int32_t view) { return dataset.views[static_cast<std::size_t>(view)].path; };
  std::vector<std::string> paths;
  for (Index i = 0; i < pairs.count(); ++i) paths.push_back(path(pairs.set(i)[0]) + " + " + path(pairs.set(i)[1]));
  return paths;
}

std::string fingerprint_of(const std::string& features, const Config& config) {
  const std::string inputs[] = {features, "pairs 1"};
  return stage_fingerprint(Stage::scores, inputs, config);
}

Scores scores_of(const std::filesystem::path& path, const Run& run, const Features& features, const Config& config,
                 const semantics::ViewSets& pairs) {
  const semantics::DistanceMatrix distances = semantics::squared_distances(
      features.values.data(), features.count, features.dimension, Parallel::shared(), run.communicator);
  const semantics::ClusteringProblems problems = clustering_problems(run.dataset, pairs, config.scores);
  const semantics::ScoreOptions options = score_options(config, features.dimension);
  const std::string fingerprint = fingerprint_of(features.input_fingerprint, config);
  const ScoringOptions how{.resume = Resume::same, .communicator = run.communicator};
  const semantics::ScoreSums sums =
      resumed_sums(path, fingerprint, pairs.count(), run.messages, how,
                   [&](semantics::ScoreSums& to, const semantics::ScoreProgress& progress) {
                     semantics::continue_set_scores(distances, pairs, problems, options, Parallel::shared(),
                                                    run.communicator, to, progress);
                   });
  Config::Scores drawn = config.scores;
  drawn.min_categories = fewest_categories(run.held_out, drawn);
  return scores_of_sums(sums, problems.pose_of_view(),
                        {.seed = options.seed,
                         .sampler = "pairs of views; " + sampler_text(drawn, false),
                         .clustering = name_of(drawn.clustering),
                         .metric = "fm",
                         .input_fingerprint = fingerprint},
                        paths_of(run.dataset, pairs));
}

}  // namespace

Config config_of_pairs(Config config) {
  constexpr Index kFewer = 10;
  constexpr double kLargerError = 3;
  Config::Scores& scores = config.scores;
  scores.rounds = 0;
  scores.min_samples = (scores.min_samples + kFewer - 1) / kFewer;
  scores.target_error *= kLargerError;
  return config;
}

semantics::ViewSets pairs_of_views(const ViewDataset& dataset, const std::vector<bool>& categories,
                                   std::uint64_t seed) {
  semantics::ViewSets pairs{.size = 2};
  for (std::size_t p = 0; p < dataset.poses.size(); ++p) {
    const ViewDataset::Pose& pose = dataset.poses[p];
    if (!categories[static_cast<std::size_t>(pose.category)]) continue;
    std::vector<std::array<std::int32_t, 2>> of_pose;
    for (Index i = 0; i < pose.view_count; ++i)
      for (Index j = i + 1; j < pose.view_count; ++j)
        of_pose.push_back(
            {static_cast<std::int32_t>(pose.first_view + i), static_cast<std::int32_t>(pose.first_view + j)});
    if (static_cast<Index>(of_pose.size()) > kMostPairsPerPose) {
      RandomStream random(seed, Stream::pairs, p);
      of_pose = shuffled(of_pose, random);
      of_pose.resize(kMostPairsPerPose);
      std::ranges::sort(of_pose);
    }
    for (const auto& pair : of_pose) pairs.views.insert(pairs.views.end(), pair.begin(), pair.end());
  }
  return pairs;
}

PairScores pair_scores_stage(const Run& run, FeaturesStage& features) {
  const Config config = config_of_pairs(run.config);
  PairScores made{.pairs = pairs_of_views(run.dataset, run.training_categories(), run.seed()), .scores = {}};
  const std::vector<std::string> backbones = scored_backbones(config.scores);
  std::vector<std::string> fingerprints;
  for (const std::string& backbone : backbones)
    fingerprints.push_back(
        fingerprint_of(features.fingerprint(backbone, scored_layer(config.scores, backbone)), config));
  const bool is_mean = backbones.size() > 1;
  const StageFile file{.path = run.folder / "pair-scores.h5",
                       .fingerprint = is_mean ? mean_scores_fingerprint(fingerprints, config) : fingerprints[0],
                       .content = "scores of pairs"};
  const auto by_backbone = [&](std::size_t i, const std::filesystem::path& path) {
    return scores_of(path, run, features.features(backbones[i], scored_layer(config.scores, backbones[i])), config,
                     made.pairs);
  };
  const auto make = [&] {
    if (!is_mean) return by_backbone(0, file.path);
    std::vector<Scores> parts;
    for (std::size_t i = 0; i < backbones.size(); ++i) {
      const StageFile part{.path = run.folder / ("pair-scores-" + backbones[i] + ".h5"),
                           .fingerprint = fingerprints[i],
                           .content = "scores of pairs of " + backbones[i]};
      parts.push_back(reuse_or_make(
          run, part, io::read_scores, [&] { return by_backbone(i, part.path); }, write_made_scores));
    }
    return mean_of_backbones(parts, backbones, poses_of(run.dataset, made.pairs), file.fingerprint);
  };
  made.scores = reuse_or_make(run, file, io::read_scores, make, write_made_scores);
  return made;
}

}  // namespace svnet::train
