#pragma once
#include "nn/graph/graph.h"

// Heads on the inputs of a camera pose (frame/pose_inputs.h).
namespace svnet::models {

/// The factor between a centred score (a score minus the mean of its pose) and the logit of a head: a sigmoid has slope
/// 1/4 at 0, so a small centred score s becomes about 0.5 + s.
inline constexpr double kLogitPerScore = 4;

/// A linear head: input `pose` (inputs), one dense layer `ridge` and a sigmoid; output `score` (1) in (0, 1).
Graph linear_head(Index inputs);

struct PoseNetworkOptions {
  Index width = 64;
  double dropout = 0.3;
};

/// A small network: input `pose` (inputs), two hidden layers, output `out` (1), a centred score.
Graph pose_network(Index inputs, const PoseNetworkOptions& options = {});

/// A linear part and `networks` networks, whose outputs one dense layer `mean` weighs: input `pose`, output `score` in
/// (0, 1). The layers of network i (from 1 on) have the names of pose_network with network_prefix(i) before them.
Graph mixed_head(Index inputs, Index networks, const PoseNetworkOptions& options = {});
std::string network_prefix(Index number);

}  // namespace svnet::models
