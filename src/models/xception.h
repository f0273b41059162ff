#pragma once
#include "nn/graph/graph.h"

namespace svnet::models {

/// Xception (Chollet, 2017) with Keras' layer names, for images (size, size, 3). The four shortcuts, which Keras
/// numbers as it makes them, are conv2d, conv2d_1, … and batch_normalization, batch_normalization_1, ….
Graph xception(Index size, bool top);

}  // namespace svnet::models
