#include <algorithm>

#include "image/resize_filter.h"

namespace svnet {
namespace {

std::uint8_t rounded(std::int32_t sum) {
  return static_cast<std::uint8_t>(std::clamp((sum + (1 << (kFilterBits - 1))) >> kFilterBits, 0, 255));
}

}  // namespace

void filter_width_reference(const ResizeFilter& filter, const std::uint8_t* in, Index rows, Index from, Index to,
                            std::uint8_t* out) {
  for (Index row = 0; row < rows; ++row, in += from * 3)
    for (Index column = 0; column < to; ++column) {
      const std::int32_t* weights = filter.weights.data() + column * filter.taps;
      const std::uint8_t* pixel = in + filter.starts[column] * 3;
      std::int32_t red = 0, green = 0, blue = 0;
      for (Index t = 0; t < filter.counts[column]; ++t, pixel += 3) {
        red += weights[t] * pixel[0];
        green += weights[t] * pixel[1];
        blue += weights[t] * pixel[2];
      }
      *out++ = rounded(red), *out++ = rounded(green), *out++ = rounded(blue);
    }
}

void filter_height_reference(const ResizeFilter& filter, const std::uint8_t* in, Index row_size, Index to,
                             std::uint8_t* out) {
  for (Index row = 0; row < to; ++row)
    for (Index x = 0; x < row_size; ++x) {
      std::int32_t sum = 0;
      for (Index t = 0; t < filter.counts[row]; ++t)
        sum += filter.weights[row * filter.taps + t] * in[(filter.starts[row] + t) * row_size + x];
      *out++ = rounded(sum);
    }
}

}  // namespace svnet
