#include "train/stages/held_out_scores.h"

#include "base/parallel.h"
#include "semantics/mean_scores.h"
#include "train/random_problems.h"
#include "train/stages/options.h"

namespace svnet::train {

semantics::SemanticScores held_out_scores(const Run& run, FeaturesStage& features_stage, std::uint64_t problems) {
  const Config& config = run.config;
  const semantics::ClusteringProblems drawn =
      clustering_problems(run.dataset, run.training_categories(), config.scores);
  std::vector<semantics::SemanticScores> scores;
  for (const std::string& backbone : scored_backbones(config.scores)) {
    const Features& features = features_stage.features(backbone, scored_layer(config.scores, backbone));
    semantics::ScoreOptions options = score_options(config, features.dimension);
    options.problems = problems;
    options.min_samples = 0;
    options.target_error = 0;
    scores.push_back(semantic_scores(
        semantics::squared_distances(features.values.data(), features.count, features.dimension, Parallel::shared()),
        drawn, options, Parallel::shared(), run.messages));
  }
  return mean_scores(scores);
}

}  // namespace svnet::train
