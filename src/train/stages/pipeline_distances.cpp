#include "train/stages/pipeline_distances.h"

#include "base/parallel.h"
#include "train/config/pipeline_name.h"

namespace svnet::train {

EvaluationPipeline PipelineDistances::pipeline(const std::string& name) {
  const PipelineName parsed = parse_pipeline(name, "evaluation.pipelines");
  const auto& [distances, dimension] = distances_of(parsed.backbone);
  return {name, &distances, {.method = parsed.clustering, .dimension = dimension}};
}

std::vector<EvaluationPipeline> PipelineDistances::pipelines() {
  std::vector<EvaluationPipeline> all;
  for (const std::string& name : config_.evaluation.pipelines) all.push_back(pipeline(name));
  return all;
}

const PipelineDistances::Distances& PipelineDistances::distances_of(const std::string& backbone) {
  const auto found = distances_.find(backbone);
  if (found != distances_.end()) return found->second;
  const Features& f = features_.features(backbone, scored_layer(config_.scores, backbone));
  return distances_
      .emplace(backbone,
               Distances(semantics::squared_distances(f.values.data(), f.count, f.dimension, Parallel::shared()),
                         f.dimension))
      .first->second;
}

}  // namespace svnet::train
