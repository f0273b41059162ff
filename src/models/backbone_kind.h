#pragma once
#include <string>
#include <vector>

#include "models/preprocessing.h"
#include "nn/graph/graph.h"

namespace svnet::models {

/// All that is known about a backbone network without its weights.
struct BackboneKind {
  std::string name;              // "mobilenet_v2"
  std::string pooled;            // the layer that gives the features if none is asked for
  std::string last_block_input;  // the only layer whose output the last block, and all that follows, reads
  Preprocessing preprocessing;
  Graph (*graph)(Index size, bool top);   // for images (size, size, 3), with Keras' layer names; `top`: with classes
  std::vector<std::string> weight_files;  // the names under which Keras publishes its weights, best first
};

}  // namespace svnet::models
