#pragma once
#include "nn/graph/graph.h"

namespace svnet::models {

/// A small network in the manner of Xception (Chollet, 2017): a strided convolution, then blocks of two separable
/// convolutions with a strided pooling and a 1×1 shortcut beside it. About 0.27 million parameters. Input (size, size,
/// 3), at least 32; the pooled output is `avg_pool` (256). It has no top.
Graph tiny_xception(Index size, bool top);

}  // namespace svnet::models
