#pragma once
#include <string_view>
#include <vector>

#include "base/enum_names.h"
#include "image/image.h"
#include "image/resize_filter.h"

namespace svnet {

/// nearest: the source pixel under the centre of each target pixel. bilinear: an antialiased triangle filter, along
/// rows, then along columns, in 8-bit fixed point. Both give the bits of Pillow's Image.resize, which Keras uses to
/// load images. One exception: if the height shrinks much more than the width, Pillow 13 filters columns first, and
/// bilinear differs by at most one level.
enum class Interpolation { nearest, bilinear };

constexpr auto enum_table(Interpolation) {
  return std::to_array<EnumName<Interpolation>>(
      {{Interpolation::nearest, "nearest"}, {Interpolation::bilinear, "bilinear"}});
}

/// Throws Error for an unknown name.
Interpolation interpolation_named(std::string_view name);

/// What resizing keeps between calls, so that later calls of the same sizes allocate nothing.
struct ResizeBuffers {
  ResizeFilter filter{};
  WidthBuffers width{};
  std::vector<Index> rows{}, columns{};  // of the nearest pixels
  std::vector<double> taps{};            // of one pixel
  Image between{}, result{};
};

/// `image` resized. Throws Error unless both sizes are positive and rgb has height x width x 3 elements.
Image resized(const Image& image, Index height, Index width, Interpolation);
/// The same: buffers.result, or `image` itself if it has that size. Valid until the buffers are used again.
const Image& resized(const Image& image, Index height, Index width, Interpolation, ResizeBuffers& buffers);

}  // namespace svnet
