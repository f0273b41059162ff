#pragma once
#include "nn/graph/graph.h"

namespace svnet::models {

/// The factor between a centred score (a score minus the mean of its pose) and the logit of a linear head: a sigmoid
/// has slope 1/4 at 0, so a small centred score s becomes about 0.5 + s.
inline constexpr double kLogitPerScore = 4;

/// A linear head: input `pose` (inputs), one dense layer `ridge` and a sigmoid; output `score` (1) in (0, 1).
Graph linear_head(Index inputs);

}  // namespace svnet::models
