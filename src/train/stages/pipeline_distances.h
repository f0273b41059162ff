#pragma once
#include <map>
#include <string>
#include <utility>

#include "train/evaluation.h"
#include "train/stages/features.h"

namespace svnet::train {

/// The distances that pipelines need, those of each backbone once. Keeps references to the arguments.
class PipelineDistances {
 public:
  PipelineDistances(const Config& config, FeaturesStage& features) : config_(config), features_(features) {}

  /// The pipeline of that name, such as "mobilenet_v2_ward". It refers to distances that live as long as this object.
  EvaluationPipeline pipeline(const std::string& name);
  /// The pipelines of the configuration.
  std::vector<EvaluationPipeline> pipelines();

 private:
  using Distances = std::pair<semantics::DistanceMatrix, Index>;  // with the features' dimension
  const Distances& distances_of(const std::string& backbone);

  const Config& config_;
  FeaturesStage& features_;
  std::map<std::string, Distances> distances_{};
};

}  // namespace svnet::train
