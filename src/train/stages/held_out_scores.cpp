#include "train/stages/held_out_scores.h"

#include "base/parallel.h"
#include "train/random_problems.h"
#include "train/stages/options.h"

namespace svnet::train {

semantics::SemanticScores held_out_scores(const Run& run, FeaturesStage& features_stage, std::uint64_t problems) {
  const Config& config = run.config;
  const Features& features = features_stage.features(config.scores.backbone, config.scores.layer);
  semantics::ScoreOptions options = score_options(config, features.dimension);
  options.problems = problems;
  options.min_samples = 0;
  options.target_error = 0;
  return semantic_scores(
      semantics::squared_distances(features.values.data(), features.count, features.dimension, Parallel::shared()),
      clustering_problems(run.dataset, run.training_categories(), config.scores), options, Parallel::shared(),
      run.messages);
}

}  // namespace svnet::train
