#pragma once
#include <cstdint>
#include <vector>

#include "base/index.h"

namespace svnet {

/// An 8-bit RGB picture: rgb is (height, width, 3), rows from the top without gaps.
struct Image {
  Index height = 0;
  Index width = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace svnet
