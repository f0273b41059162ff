#include "train/stages/wanted_scores.h"

#include "train/config/fingerprint.h"

namespace svnet::train {

std::string wanted_scores_fingerprint(const Config& config, FeaturesStage& features) {
  std::vector<std::string> scores;
  for (const std::string& backbone : scored_backbones(config.scores))
    scores.push_back(scores_fingerprint(features.fingerprint(backbone, scored_layer(config.scores, backbone)), config));
  return scores.size() == 1 ? scores[0] : mean_scores_fingerprint(scores, config);
}

}  // namespace svnet::train
