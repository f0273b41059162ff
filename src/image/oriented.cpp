#include "image/oriented.h"

#include <algorithm>

namespace svnet {

Image oriented(Image image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  const bool swaps_axes = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const Index height = swaps_axes ? image.width : image.height, width = swaps_axes ? image.height : image.width;
  Image result{height, width, std::vector<std::uint8_t>(image.rgb.size())};
  std::uint8_t* to = result.rgb.data();
  for (Index y = 0; y < height; ++y)
    for (Index x = 0; x < width; ++x, to += 3) {
      Index row = swaps_axes ? x : y, column = swaps_axes ? y : x;
      if (from_bottom) row = image.height - 1 - row;
      if (from_right) column = image.width - 1 - column;
      std::copy_n(image.rgb.data() + (row * image.width + column) * 3, 3, to);
    }
  return result;
}

}  // namespace svnet
