#pragma once
#include <string_view>
#include <vector>

#include "base/enum_names.h"
#include "image/image.h"

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
  /// A filter along one axis: target[i] = Σ weights[i * taps + t] · source[starts[i] + t] over t < counts[i]. Weights
  /// are in units of 2^-22 and add up to about 1.
  struct Filter {
    Index taps = 0;
    std::vector<Index> starts{}, counts{};
    std::vector<std::int32_t> weights{};
  };
  Filter filter{};
  std::vector<Index> rows{}, columns{};  // of the nearest pixels
  std::vector<double> taps{};            // of one pixel
  std::vector<std::int32_t> sums{};      // of one row
  Image between{}, result{};
};

/// `image` resized. Throws Error unless both sizes are positive and rgb has height x width x 3 elements.
Image resized(const Image& image, Index height, Index width, Interpolation);
/// The same: buffers.result, or `image` itself if it has that size. Valid until the buffers are used again.
const Image& resized(const Image& image, Index height, Index width, Interpolation, ResizeBuffers& buffers);

}  // namespace svnet
