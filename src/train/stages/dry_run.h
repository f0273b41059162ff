#pragma once
#include "train/run.h"

namespace svnet::train {

/// Runs every stage once, on a few views of each category, in a folder that is removed again. Throws what a real run
/// would throw.
void dry_run(const Config& config, const ViewDataset& dataset, const Messages& messages,
             const InferenceOptions& inference = {});

}  // namespace svnet::train
