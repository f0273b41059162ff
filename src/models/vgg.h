#pragma once
#include "nn/graph/graph.h"

namespace svnet::models {

/// VGG16 and VGG19 (Simonyan & Zisserman, 2015) with Keras' layer names, for images (size, size, 3). The top (flatten,
/// fc1, fc2, predictions) is only defined for the size that its weights are made for, 224.
Graph vgg16(Index size, bool top);
Graph vgg19(Index size, bool top);

}  // namespace svnet::models
