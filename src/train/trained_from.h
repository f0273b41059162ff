#pragma once
#include "models/registry.h"
#include "train/config/choices.h"

namespace svnet {

/// The layer of a backbone's graph above which layers are trained, up to `output`: the output itself where none is.
/// Throws Error where the last block is to be trained and `output` is not above its input.
NodeId trained_from(FineTune fine_tune, const BackboneKind& kind, const Graph& graph, NodeId output);

}  // namespace svnet
