#pragma once
#include <cstddef>

#include "base/error.h"
#include "image/image.h"

namespace svnet::frame {

/// Throws Error unless an image has pixels and (height, width, per_pixel) values. `what` names it: "depth image".
inline void check_image(const char* what, Index height, Index width, std::size_t values, Index per_pixel) {
  check(height > 0 && width > 0, "[frame] the ", what, " is empty: ", height, "x", width, " pixels");
  check(height <= kMostPixels / width, "[frame] the ", what, " of ", height, "x", width, " pixels is too large");
  check(static_cast<Index>(values) == height * width * per_pixel, "[frame] the ", what, " of ", height, "x", width,
        " pixels has ", values, " values, expected ", height * width * per_pixel);
}

}  // namespace svnet::frame
