#pragma once
#include <vector>

#include "base/index.h"

namespace svnet {

/// Distances along the camera's axis in metres, (height, width), rows from the top; 0 where the camera measured
/// nothing.
struct DepthImage {
  Index height = 0;
  Index width = 0;
  std::vector<float> metres;
};

}  // namespace svnet
