#include "train/scores_stage.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "base/sha256.h"
#include "base/text.h"
#include "semantics/semantic_scores.h"
#include "train/clustering_choice.h"

namespace svnet {
namespace {

std::string sampler_text(const Config::Scores& s) {
  const auto bound = [](Index value) { return value == 0 ? std::string("all") : std::to_string(value); };
  return joined("uniform; categories ", s.min_categories, " to ", bound(s.max_categories), ", objects ", s.min_objects,
                " to ", bound(s.max_objects), ", one pose, one view; singletons ",
                s.singletons == Config::Scores::Singletons::zero ? "zero" : "skip");
}

}  // namespace

ClusteringProblems clustering_problems(const ViewDataset& dataset, const std::vector<bool>& excluded,
                                       const Config::Scores& config) {
  std::vector<std::int64_t> category, object, pose, excluded_numbers;
  for (const View& view : dataset.views) {
    category.push_back(view.category);
    object.push_back(view.object);
    pose.push_back(view.pose);
  }
  for (std::size_t c = 0; c < excluded.size(); ++c)
    if (excluded[c]) excluded_numbers.push_back(static_cast<std::int64_t>(c));
  std::vector<Index> objects(dataset.categories.size(), 0);
  for (const auto& each : dataset.objects) ++objects[static_cast<std::size_t>(each.category)];
  for (std::size_t c = 0; c < objects.size(); ++c)
    check(excluded[c] || objects[c] >= config.min_objects, "scores.min_objects: ", config.min_objects,
          ", but category '", dataset.categories[c], "' has ", objects[c], " objects");
  const auto available = static_cast<Index>(excluded.size() - excluded_numbers.size());
  return {category, object, pose,
          ProblemOptions{.min_categories = std::min(config.min_categories, available),
                         .max_categories = config.max_categories,
                         .min_objects = config.min_objects,
                         .max_objects = config.max_objects,
                         .excluded_categories = excluded_numbers}};
}

std::string scores_fingerprint(const std::string& features_fingerprint, const Config& config) {
  const auto& s = config.scores;
  Sha256 hash;
  hash.update_field("scores 1")
      .update_field(features_fingerprint)
      .update_field(joined_with("\n", config.dataset.held_out));
  hash.update_field(sampler_text(s)).update_field(clustering_name(s.clustering));
  hash.update_field(joined(config.seed, " ", s.problems, " ", s.min_samples, " ", std::hexfloat, s.target_error));
  return hash.hex();
}

Scores make_scores(const ViewDataset& dataset, const Features& features, const std::vector<bool>& excluded,
                   const Config& config, const Messages& messages) {
  const auto& s = config.scores;
  const DistanceMatrix distances =
      squared_distances(features.values.data(), features.count, features.dimension, Parallel::shared());
  const ClusteringProblems problems = clustering_problems(dataset, excluded, s);
  const ScoreOptions options{
      .problems = static_cast<std::uint64_t>(s.problems),
      .min_samples = static_cast<std::uint64_t>(s.min_samples),
      .target_error = s.target_error,
      .seed = static_cast<std::uint64_t>(config.seed),
      .singletons = s.singletons == Config::Scores::Singletons::zero ? Singletons::zero : Singletons::skip,
      .clustering = clustering_options(s.clustering, features.dimension)};
  SemanticScores made = semantic_scores(distances, problems, options, Parallel::shared(), messages);

  Scores scores{ScoresOrigin{.problems = static_cast<Index>(made.problems),
                             .seed = options.seed,
                             .sampler = sampler_text(s),
                             .clustering = clustering_name(s.clustering),
                             .metric = "fm",
                             .input_fingerprint = scores_fingerprint(features.input_fingerprint, config)},
                std::move(made.individual),
                std::move(made.global),
                {},
                std::move(made.count),
                std::move(made.standard_error),
                features.paths};
  scores.scaled = scaled_per_pose(scores.individual, problems.pose_of_view());
  return scores;
}

}  // namespace svnet
