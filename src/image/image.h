#pragma once
#include <cstdint>
#include <vector>

#include "base/index.h"

namespace svnet {

/// The largest number of pixels of an image that is read.
constexpr Index kMostPixels = 64'000'000;

/// An 8-bit RGB image: rgb is (height, width, 3), rows from the top, contiguous.
struct Image {
  Index height = 0;
  Index width = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace svnet
