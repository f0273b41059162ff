#pragma once
#include <string>

#include "semantics/clusterer.h"

namespace svnet::train {

/// One of evaluation.pipelines: "mobilenet_v2_ward" means features of mobilenet_v2, clustered by ward.
struct PipelineName {
  std::string backbone;
  semantics::Clustering clustering;
};
/// Throws Error, beginning with `where`, unless `name` is BACKBONE_CLUSTERING.
PipelineName parse_pipeline(const std::string& name, const std::string& where);

}  // namespace svnet::train
