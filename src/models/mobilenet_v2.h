#pragma once
#include "nn/graph/graph.h"

namespace svnet::models {

/// MobileNetV2 (Sandler et al., 2018), width 1, with Keras' layer names. Input (size, size, 3), at least 32; the pooled
/// output is `global_average_pooling2d` (1280); with `top`, the 1000 classes of ImageNet follow as `predictions`.
Graph mobilenet_v2(Index size, bool top);

}  // namespace svnet::models
