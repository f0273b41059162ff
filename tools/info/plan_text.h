#pragma once
#include <filesystem>
#include <string>

#include "nn/runtime/inference.h"

namespace svnet {

/// A table of the steps that a compiled network runs for a batch: layer, kernel, MFLOP, MB moved, the time of the
/// fastest of several runs, and GFLOP/s. The last lines are the totals and the memory that a run needs.
std::string plan_text(const Inference& network, Index batch);

/// The plan of a backbone with random weights up to `layer` ("" for its pooled output), or of the two networks of a
/// model file. Throw Error if the backbone or the layer is unknown, or if the file is no model.
std::string backbone_plan(const std::string& name, const std::string& layer, Index batch,
                          const InferenceOptions& options);
std::string model_plan(const std::filesystem::path& file, Index batch, const InferenceOptions& options);

}  // namespace svnet
