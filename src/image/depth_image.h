#pragma once
#include <vector>

#include "base/index.h"

namespace svnet {

/// Depth along the camera's optical axis in metres, (height, width), rows from the top. 0: not measured.
struct DepthImage {
  Index height = 0;
  Index width = 0;
  std::vector<float> metres;
  /// The length in metres of the unit that the file was read in (image/depth_unit.h); 0: none.
  double unit_m = 0;
};

}  // namespace svnet
