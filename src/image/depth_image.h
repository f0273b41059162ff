#pragma once
#include <vector>

#include "base/index.h"

namespace svnet {

/// Depth along the camera's optical axis in metres, (height, width), rows from the top. 0: not measured.
struct DepthImage {
  Index height = 0;
  Index width = 0;
  std::vector<float> metres;
};

}  // namespace svnet
