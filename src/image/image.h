#pragma once
#include <cstdint>
#include <vector>

#include "base/index.h"

namespace svnet {

/// No picture that is read or taken may have more.
constexpr Index kMostPixels = 64'000'000;

/// An 8-bit RGB picture: rgb is (height, width, 3), rows from the top without gaps.
struct Image {
  Index height = 0;
  Index width = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace svnet
