#pragma once
#include <string>

#include "nn/layers/initializer.h"
#include "nn/tensor.h"

namespace svnet {

/// One array that a layer owns, in Keras' order of a layer's weights. Arrays without a gradient (moving statistics)
/// come last.
struct ParameterSpec {
  std::string name;
  Shape shape{};
  Initializer initializer;
  bool trainable = true;
};

}  // namespace svnet
