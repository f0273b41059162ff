#pragma once
#include "models/registry.h"
#include "train/config/choices.h"

namespace svnet::train {

/// The node of a backbone's graph whose output is the first trained layer's input; `output` itself if no layer is
/// trained. Throws Error if fine_tune is last_block and `output` is not above the input of the last block.
NodeId trained_from(FineTune fine_tune, const models::BackboneKind& kind, const Graph& graph, NodeId output);

}  // namespace svnet::train
